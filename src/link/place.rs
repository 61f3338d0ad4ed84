//! Where the sockets are: in `halflight` below `$XDG_RUNTIME_DIR`, otherwise in the state folder.

use std::env;
use std::ffi::OsStr;
use std::io;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use file::Digest;
use file::state_folder::{self, Folder, Store};

/// The end of the names of sockets.
const SOCKET: &str = ".socket";

/// How much of a digest is in a name: paths of sockets hold 107 bytes, on macOS 103.
const DIGITS: usize = 24;

/// The folder of the sockets, and the name of one.
#[derive(Debug)]
pub struct Place {
    pub(crate) folder: Folder,
    pub(crate) name: String,
}

impl Place {
    /// The place of a scene's socket. Two paths of one file have the same.
    ///
    /// # Errors
    ///
    /// Fails if the folder is missing and cannot be created, or if others can write there.
    pub fn of(scene: &Path) -> io::Result<Self> {
        Self::within(&around()?, scene)
    }

    /// The place of a scene's socket, if the folder exists.
    pub(crate) fn find(scene: &Path) -> io::Result<Option<Self>> {
        let folder = Folder::find(&around()?, Store::Sockets)?;
        let place = |folder| {
            let name = name_of(scene)?;
            Ok(Self { folder, name })
        };
        folder.map(place).transpose()
    }

    /// As [`Place::of`], in the folder of sockets within this one.
    pub(crate) fn within(around: &Path, scene: &Path) -> io::Result<Self> {
        Ok(Self {
            name: name_of(scene)?,
            folder: Folder::make(around, Store::Sockets)?,
        })
    }

    /// The path of the socket.
    pub fn path(&self) -> PathBuf {
        self.folder.place(&self.name)
    }
}

/// The sockets that are there, in order.
///
/// # Errors
///
/// Fails if others can write to the folder, or if there can be none.
pub fn sockets() -> io::Result<Vec<Place>> {
    let around = around()?;
    let find = || Folder::find(&around, Store::Sockets);
    let Some(folder) = find()? else {
        return Ok(Vec::new());
    };
    let mut names = folder.names();
    names.retain(|name| name.ends_with(SOCKET));
    names.sort();
    let mut places = Vec::with_capacity(names.len());
    for name in names {
        places.extend(find()?.map(|folder| Place { folder, name }));
    }
    Ok(places)
}

/// The name of a scene's socket.
fn name_of(scene: &Path) -> io::Result<String> {
    let scene = canonical(scene)?;
    let digest = Digest::of([scene.as_os_str().as_bytes()]);
    Ok(format!("{}{SOCKET}", &digest[..DIGITS]))
}

/// The folder that the folder of the sockets is in.
fn around() -> io::Result<PathBuf> {
    let runtime = env::var_os("XDG_RUNTIME_DIR").map(PathBuf::from);
    match runtime.filter(|path| path.is_absolute()) {
        Some(runtime) => Ok(runtime),
        None => state_folder::path(),
    }
}

/// The path of a file without links, which need not exist yet.
fn canonical(path: &Path) -> io::Result<PathBuf> {
    path.canonicalize().or_else(|_| {
        let folder = file::directory_of(path).canonicalize()?;
        Ok(folder.join(path.file_name().unwrap_or_else(|| OsStr::new(""))))
    })
}
