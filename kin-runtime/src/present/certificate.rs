//! Certificates, in words and as records for JSON.

use super::json::{Record, fields, record};
use crate::certificate::{Certificate, Uncertified};
use crate::model::Model;

/// A certificate, or why there is none.
pub(crate) type Certified = Result<Certificate, Uncertified>;

/// A certificate with the largest radius of its intervals of q and the smallest radius of the box without another
/// solution, or why there is none.
pub(crate) fn record(certified: &Certified) -> Record {
    let certificate = certified.as_ref().ok();
    let mut all = record! {
        certified: certificate.is_some(),
        radius: certificate.map(Certificate::radius),
        isolation: certificate.map(Certificate::isolation),
        why: certified.as_ref().err().map(ToString::to_string),
    };
    all.extend(certificate.map(fields).unwrap_or_default());
    all
}

/// The bounds of every coordinate, its rate and its acceleration as columns with their names; NaN without a certificate.
pub(crate) fn columns(model: &Model, certified: &Certified) -> Vec<(String, f64)> {
    let lists = certified.as_ref().ok().map(|certificate| [&certificate.q, &certificate.q_dot, &certificate.q_ddot]);
    let mut all = Vec::new();
    for (k, coordinate) in model.coordinates.iter().enumerate() {
        for (order, suffix) in ["", "_dot", "_ddot"].into_iter().enumerate() {
            let interval = lists.and_then(|lists| lists[order].get(k));
            let bounds = interval.map_or([f64::NAN; 2], |interval| [interval.lower(), interval.upper()]);
            let name = |end: &str| format!("{}{suffix}_{end}", coordinate.name);
            all.extend(["lower", "upper"].map(name).into_iter().zip(bounds));
        }
    }
    all
}

/// The certificate in a sentence.
pub(crate) fn words(certified: &Certified) -> String {
    match certified {
        Ok(certificate) => certificate.to_string(),
        Err(why) => format!("none: {why}"),
    }
}

/// The section of a report.
pub(crate) fn text(certified: &Certified) -> String {
    format!("\nCertificate\n  {}\n", words(certified))
}
