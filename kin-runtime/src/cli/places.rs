//! Numbers and positions in files of comma-separated values.

use super::failure::Failure;

/// The numbers of a file, whose first line may have names of columns. These must be the names in one of `lists`,
/// perhaps with a prefix: `tip.x` is accepted for `x`. If `lists` is empty, all names are accepted.
pub(super) fn columns(option: &str, file: &str, lists: &[&[&str]]) -> Result<Vec<Vec<f64>>, Failure> {
    let cannot = |why: String| Failure::option(option, format!("cannot read `{file}`: {why}"));
    let reader = csv::ReaderBuilder::new().has_headers(false).trim(csv::Trim::All).from_path(file);
    let mut rows = Vec::new();
    for (line, record) in reader.map_err(|error| cannot(error.to_string()))?.records().enumerate() {
        let record = record.map_err(|error| cannot(error.to_string()))?;
        match record.iter().map(str::parse).collect::<Result<Vec<f64>, _>>() {
            Ok(numbers) => match numbers.iter().find(|number| !number.is_finite()) {
                Some(number) => return Err(cannot(format!("line {} has {number}, which is not finite", line + 1))),
                None => rows.push(numbers),
            },
            Err(_) if line == 0 => {
                let is = |(name, wanted): (&str, &&str)| name == *wanted || name.rsplit('.').next() == Some(*wanted);
                let fits = |list: &&[&str]| list.len() == record.len() && record.iter().zip(list.iter()).all(is);
                if !lists.is_empty() && !lists.iter().any(fits) {
                    let wanted: Vec<String> = lists.iter().map(|list| list.join(",")).collect();
                    let found: Vec<&str> = record.iter().collect();
                    return Err(cannot(format!("its columns are {}, not {}", found.join(","), wanted.join(" or "))));
                }
            }
            Err(_) => return Err(cannot(format!("line {} has something that is no number", line + 1))),
        }
    }
    if rows.is_empty() { Err(cannot("there are no numbers in it".to_owned())) } else { Ok(rows) }
}

/// The columns of positions, and of positions with their times.
pub(super) const PLACES: [&[&str]; 2] = [&["x", "y"], &["t", "x", "y"]];

/// The positions of a path: the columns x,y or t,x,y.
pub(super) fn places(option: &str, file: &str) -> Result<Vec<[f64; 2]>, Failure> {
    let place = |row: Vec<f64>| match row[..] {
        [x, y] | [_, x, y] => Ok([x, y]),
        _ => {
            let message = format!("`{file}` needs the columns x,y or t,x,y, not {}", row.len());
            Err(Failure::option(option, message))
        }
    };
    columns(option, file, &PLACES)?.into_iter().map(place).collect()
}
