//! Whether a scheduler answers at an address, and whether it has workers.

use crate::engine::Watch;
use crate::error::StudyError;
use std::io::{self, BufRead, BufReader, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// How long a client waits for the first worker.
pub(super) const WAIT: Duration = Duration::from_secs(20);

/// Host and port.
pub(super) fn parts(address: &str) -> Result<(String, u16), StudyError> {
    let found = address.rsplit_once(':').and_then(|(host, port)| Some((host.to_owned(), port.parse().ok()?)));
    found.ok_or_else(|| StudyError::description(format!("`{address}` is no address of a scheduler: write HOST:PORT")))
}

/// Waits until a scheduler has workers.
pub(super) fn ready(scheduler: &str, watch: &Watch) -> Result<(), StudyError> {
    let (host, port) = parts(scheduler)?;
    let began = Instant::now();
    loop {
        match ask(&host, port) {
            Ok(true) => return Ok(()),
            Err(Silence::SomethingElse) => return Err(something_else(scheduler)),
            Err(Silence::Nobody(error)) => {
                return Err(StudyError::Cluster(format!("no scheduler answers at {scheduler}: {error}")));
            }
            Ok(false) if began.elapsed() > WAIT || watch.stop.load(Ordering::Relaxed) => {
                let message = format!("{scheduler} has no workers; start some: `worker --scheduler {scheduler}`");
                return Err(StudyError::Cluster(message));
            }
            Ok(false) => std::thread::sleep(Duration::from_millis(200)),
        }
    }
}

/// Why no scheduler answers.
pub(super) enum Silence {
    Nobody(io::Error),
    SomethingElse,
}

pub(super) fn something_else(scheduler: &str) -> StudyError {
    StudyError::Cluster(format!("the server at {scheduler} is not a kin-study scheduler"))
}

/// Whether the scheduler at an address has workers.
pub(super) fn ask(host: &str, port: u16) -> Result<bool, Silence> {
    let mut last = io::Error::new(io::ErrorKind::NotFound, "no such host");
    for address in (host, port).to_socket_addrs().map_err(Silence::Nobody)? {
        match TcpStream::connect_timeout(&address, Duration::from_secs(5)) {
            Ok(stream) => return has_workers(stream, host),
            Err(error) => last = error,
        }
    }
    Err(Silence::Nobody(last))
}

/// Whether a scheduler has workers, by HTTP: it answers 200 if it has some and 503 if it has none.
fn has_workers(mut stream: TcpStream, host: &str) -> Result<bool, Silence> {
    let mut line = String::new();
    let mut answer = || {
        stream.set_read_timeout(Some(Duration::from_secs(5)))?;
        // In one write: a server that is no scheduler may answer and close the connection after the first line.
        let question = format!("GET /readyz HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n");
        stream.write_all(question.as_bytes())?;
        BufReader::new(&stream).read_line(&mut line)
    };
    answer().map_err(Silence::Nobody)?;
    match line.split_whitespace().nth(1) {
        Some("200") => Ok(true),
        Some("503") => Ok(false),
        _ => Err(Silence::SomethingElse),
    }
}
