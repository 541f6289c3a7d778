//! Files that are there whole or not at all.

use std::ffi::OsString;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes `contents` to `path`: to a temporary file beside it first, which then takes its place.
///
/// A reader sees the old contents or the new ones, never a part. What is no regular file (a pipe, a terminal) is
/// written to directly; a symbolic link stays and the file it names is replaced.
///
/// # Errors
/// What the file system reports; the temporary file is removed then.
pub fn write_atomically(path: &Path, contents: &[u8]) -> io::Result<()> {
    let existing = fs::metadata(path).ok();
    if existing.as_ref().is_some_and(|m| m.is_dir()) {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a directory"));
    }
    if existing.as_ref().is_some_and(|m| !m.is_file()) {
        let mut file = OpenOptions::new().write(true).open(path)?;
        return file.write_all(contents).and_then(|()| file.flush());
    }
    let target = match existing {
        Some(_) => fs::canonicalize(path)?,
        None => path.to_path_buf(),
    };
    let temporary = temporary_beside(&target)?;
    let written = write_new(&temporary, contents)
        .and_then(|()| existing.map_or(Ok(()), |m| fs::set_permissions(&temporary, m.permissions())))
        .and_then(|()| fs::rename(&temporary, &target));
    if written.is_err() {
        // The first error is the one to report; a leftover temporary file is no second one.
        let _ = fs::remove_file(&temporary);
    }
    written
}

fn write_new(path: &Path, contents: &[u8]) -> io::Result<()> {
    let mut file = OpenOptions::new().write(true).create_new(true).open(path)?;
    file.write_all(contents)?;
    file.sync_all()
}

/// A name in the same directory that nobody has.
fn temporary_beside(path: &Path) -> io::Result<PathBuf> {
    let name = path.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "it names no file"))?;
    let candidate = |n: u32| {
        let mut text = OsString::from(".");
        text.push(name);
        text.push(format!(".{}.{n}.tmp", std::process::id()));
        path.with_file_name(text)
    };
    (0..100)
        .map(candidate)
        .find(|p| !p.exists())
        .ok_or_else(|| io::Error::new(io::ErrorKind::AlreadyExists, "its temporary files are still there"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scratch(name: &str) -> io::Result<PathBuf> {
        let dir = std::env::temp_dir().join(format!("kin-output-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&dir);
        fs::create_dir_all(&dir)?;
        Ok(dir)
    }

    #[test]
    fn replaces_the_contents_and_leaves_nothing_else() -> io::Result<()> {
        let dir = scratch("replace")?;
        let path = dir.join("result.csv");
        write_atomically(&path, b"first")?;
        write_atomically(&path, b"second")?;
        assert_eq!(fs::read(&path)?, b"second");
        assert_eq!(fs::read_dir(&dir)?.count(), 1);
        fs::remove_dir_all(&dir)
    }

    #[test]
    fn a_directory_is_refused() -> io::Result<()> {
        let dir = scratch("directory")?;
        assert!(write_atomically(&dir, b"x").is_err());
        assert!(write_atomically(&dir.join("missing/result.csv"), b"x").is_err());
        fs::remove_dir_all(&dir)
    }
}
