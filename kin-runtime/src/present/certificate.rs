//! Certificates, in words and as records for JSON.

use serde::Serialize;

use crate::certificate::{Certificate, Uncertified};

/// The result of asking for a certificate.
pub(crate) type Certified = Result<Certificate, Uncertified>;

/// A certificate, or why there is none.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct CertificateRecord {
    certified: bool,
    /// Largest radius of the intervals of q.
    radius: Option<f64>,
    /// Smallest radius of the box without another solution.
    isolation: Option<f64>,
    /// Why there is no certificate.
    why: Option<String>,
    #[serde(flatten)]
    certificate: Option<Certificate>,
}

impl CertificateRecord {
    pub(crate) fn of(certified: &Certified) -> Self {
        let certificate = certified.as_ref().ok();
        Self {
            certified: certificate.is_some(),
            radius: certificate.map(Certificate::radius),
            isolation: certificate.map(Certificate::isolation),
            why: certified.as_ref().err().map(ToString::to_string),
            certificate: certificate.cloned(),
        }
    }
}

/// Writes the record of a certificate that may not have been asked for.
pub(crate) fn record<S: serde::Serializer>(certified: &Option<Certified>, serializer: S) -> Result<S::Ok, S::Error> {
    certified.as_ref().map(CertificateRecord::of).serialize(serializer)
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
