//! The function that workers evaluate: the results of a range of rows of a study.

use super::parcel::packed;
use crate::engine::solve;
use crate::error::StudyError;
use crate::rows::Prepared;
use crate::study::Study;
use datafusion::arrow::array::{AsArray, BinaryArray};
use datafusion::arrow::datatypes::{DataType, UInt64Type};
use datafusion::common::{Result, ScalarValue, exec_err};
use datafusion::logical_expr::{ColumnarValue, ScalarFunctionArgs, ScalarUDF, ScalarUDFImpl, Signature, Volatility};
use kin_runtime::Mechanism;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// The function of the text of a study, the first row and the end of a range: the results of these rows as bytes.
pub(super) struct Function {
    /// It contains a hash of this program's file, so that another program, or another build, reports it as unknown.
    name: String,
    signature: Signature,
    prepare: fn(&Study) -> Result<Prepared, StudyError>,
    /// The study of the last call.
    last: Mutex<Option<(String, Arc<Prepared>)>>,
}

impl Function {
    /// The function for a mechanism in this program.
    pub(super) fn of<M>() -> Result<ScalarUDF, StudyError>
    where
        M: Mechanism + Default + Send + Sync + 'static,
    {
        let arguments = vec![DataType::Utf8, DataType::UInt64, DataType::UInt64];
        Ok(ScalarUDF::new_from_impl(Self {
            name: format!("rows_of_{}_{:016x}", M::model().name.to_lowercase(), program()?),
            signature: Signature::exact(arguments, Volatility::Volatile),
            prepare: Prepared::new::<M>,
            last: Mutex::default(),
        }))
    }

    fn prepared(&self, text: &str) -> Result<Arc<Prepared>, StudyError> {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, prepared)) = last.as_ref().filter(|(known, _)| known == text) {
            return Ok(Arc::clone(prepared));
        }
        let prepared = Arc::new((self.prepare)(&Study::from_toml(text)?)?);
        *last = Some((text.to_owned(), Arc::clone(&prepared)));
        Ok(prepared)
    }
}

impl ScalarUDFImpl for Function {
    fn name(&self) -> &str {
        &self.name
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        Ok(DataType::Binary)
    }

    fn invoke_with_args(&self, arguments: ScalarFunctionArgs) -> Result<ColumnarValue> {
        let [ColumnarValue::Scalar(ScalarValue::Utf8(Some(text))), starts, ends] = &arguments.args[..] else {
            return exec_err!("the rows of one study are computed at a time");
        };
        let numbers = |column: &ColumnarValue| column.to_array(arguments.number_rows);
        let (starts, ends) = (numbers(starts)?, numbers(ends)?);
        let ranges =
            starts.as_primitive::<UInt64Type>().values().iter().zip(ends.as_primitive::<UInt64Type>().values());
        let external = |error: StudyError| datafusion::error::DataFusionError::Execution(error.to_string());
        let prepared = self.prepared(text).map_err(external)?;
        let mut parcels = Vec::with_capacity(starts.len());
        for (start, end) in ranges {
            let (batch, summary) = solve(&prepared, *start..*end).map_err(external)?;
            parcels.push(packed(batch, &summary)?);
        }
        Ok(ColumnarValue::Array(Arc::new(BinaryArray::from_iter_values(parcels))))
    }
}

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Function {}

impl Hash for Function {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

/// A hash of this program's file, which distinguishes it from other programs: FNV-1a with words of eight bytes and a
/// rotation.
fn program() -> Result<u64, StudyError> {
    let file = std::env::current_exe().map_err(|error| StudyError::file(Path::new("this program"), error))?;
    let bytes = std::fs::read(&file).map_err(|error| StudyError::file(&file, error))?;
    let step = |hash: u64, word: u64| (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(23);
    let (words, rest) = bytes.as_chunks::<8>();
    let words = words.iter().map(|word| u64::from_le_bytes(*word));
    let rest = rest.iter().map(|byte| u64::from(*byte));
    Ok(words.chain(rest).fold(0xcbf2_9ce4_8422_2325, step))
}
