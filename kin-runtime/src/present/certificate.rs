//! Certificates, in words and as records for JSON.

use super::json::{Record, fields, record};
use crate::certificate::{Certificate, Uncertified};

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
