//! Files that are replaced only after all of their new contents are written.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Longest chain of symbolic links that is followed.
const LINKS: usize = 40;

/// Writes `contents` to `path`: to a temporary file beside it first, which then takes its place.
///
/// A reader sees the old contents or the new ones, never a part. A pipe, a terminal or another special file is written
/// directly. A symbolic link stays; the file that it names is replaced, or created if it does not exist. Permissions
/// are kept, and a file without permission to write is not replaced.
///
/// # Errors
/// The errors of the file system; the temporary file is then removed.
pub(crate) fn write_atomically(path: &Path, contents: &[u8]) -> io::Result<()> {
    write_atomically_by(path, |file| file.write_all(contents))
}

/// As [`write_atomically`], with contents that are written piece by piece; if `write` fails, the old contents stay.
///
/// # Errors
/// The errors of the file system and of `write`.
pub(crate) fn write_atomically_by(path: &Path, write: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    let existing = match fs::metadata(path) {
        Ok(metadata) => Some(metadata),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    if existing.as_ref().is_some_and(|m| m.is_dir()) {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a directory"));
    }
    if existing.is_some() {
        // Opening the file checks the permission to write and changes nothing.
        let mut file = OpenOptions::new().write(true).open(path)?;
        if existing.as_ref().is_some_and(|m| !m.is_file()) {
            return write(&mut file).and_then(|()| file.flush());
        }
    }
    let target = match existing {
        Some(_) => fs::canonicalize(path)?,
        None => beyond_links(path)?,
    };
    let name = target.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "it names no file"))?;
    let mut prefix = OsString::from(".");
    prefix.push(name);
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".tmp");
    // A new file has the permissions that the umask gives; a replaced one is private until it gets those of the old
    // file.
    #[cfg(unix)]
    if existing.is_none() {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let directory = target.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = builder.tempfile_in(directory)?;
    if let Some(metadata) = existing {
        file.as_file().set_permissions(metadata.permissions())?;
    }
    write(file.as_file_mut())?;
    file.as_file().sync_all()?;
    file.persist(&target)?;
    Ok(())
}

/// The target of a path that does not exist: symbolic links are followed to their end.
fn beyond_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_path_buf();
    for _ in 0..LINKS {
        match fs::read_link(&path) {
            Ok(next) => path = path.parent().unwrap_or(Path::new("")).join(next),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("too many symbolic links"))
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
    fn a_temporary_file_of_someone_else_stays() -> io::Result<()> {
        let dir = scratch("others")?;
        let others = dir.join(".results.csv.000000.tmp");
        fs::write(&others, "theirs")?;
        write_atomically(&dir.join("results.csv"), b"mine")?;
        assert_eq!((fs::read(&others)?, fs::read(dir.join("results.csv"))?), (b"theirs".to_vec(), b"mine".to_vec()));
        fs::remove_dir_all(dir)
    }

    #[test]
    fn a_directory_is_refused() -> io::Result<()> {
        let dir = scratch("directory")?;
        assert!(write_atomically(&dir, b"x").is_err());
        assert!(write_atomically(&dir.join("missing/result.csv"), b"x").is_err());
        fs::remove_dir_all(&dir)
    }

    #[cfg(unix)]
    #[test]
    fn links_and_permissions_stay_what_they_are() -> io::Result<()> {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let dir = scratch("links")?;
        let (file, link, further) = (dir.join("file.csv"), dir.join("link.csv"), dir.join("further.csv"));
        symlink("file.csv", &link)?;
        symlink("link.csv", &further)?;
        // At the first write the target of the links does not exist.
        for contents in [b"first".as_slice(), b"second"] {
            write_atomically(&further, contents)?;
            assert_eq!(fs::read(&file)?, contents);
            assert!(fs::symlink_metadata(&link)?.is_symlink() && fs::symlink_metadata(&further)?.is_symlink());
            assert_eq!(fs::metadata(&file)?.permissions().mode() & 0o100, 0);
        }
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640))?;
        write_atomically(&link, b"third")?;
        assert_eq!((fs::metadata(&file)?.permissions().mode() & 0o777, fs::read(&file)?), (0o640, b"third".to_vec()));
        let (a, b) = (dir.join("a"), dir.join("b"));
        symlink(&a, &b)?;
        symlink(&b, &a)?;
        assert!(write_atomically(&a, b"x").is_err(), "a circle");
        assert_eq!(fs::read_dir(&dir)?.count(), 5, "nothing is left over");
        fs::remove_dir_all(&dir)
    }

    #[test]
    fn what_fails_leaves_the_file_whole() -> io::Result<()> {
        let dir = scratch("whole")?;
        // A name that is just short enough leaves no room for a temporary one beside it.
        let path = dir.join("x".repeat(255));
        fs::write(&path, "first")?;
        assert!(write_atomically(&path, b"second").is_err());
        assert_eq!(fs::read(&path)?, b"first");
        assert_eq!(fs::read_dir(&dir)?.count(), 1);
        fs::remove_dir_all(&dir)
    }
}
