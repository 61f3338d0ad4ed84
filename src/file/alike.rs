//! The attributes that a new file takes over from the file it replaces.

use std::fs::{File, Metadata};
use std::io;
use std::path::Path;

use super::calls::call;

/// Copies owner, extended attributes and mode of the file at `path` to `twin`.
pub(super) fn take_after(path: &Path, metadata: &Metadata, twin: &File) -> io::Result<()> {
    use rustix::fs::{Gid, Uid, fchown};
    use std::os::unix::fs::MetadataExt;
    let own = twin.metadata()?;
    if (own.uid(), own.gid()) != (metadata.uid(), metadata.gid()) {
        let owner = Uid::from_raw(metadata.uid());
        let group = Gid::from_raw(metadata.gid());
        call("fchown", || Ok(fchown(twin, Some(owner), Some(group))?))?;
    }
    copy_attributes(path, twin)?;
    // After the owner: changing it clears bits of the mode.
    call("chmod", || twin.set_permissions(metadata.permissions()))
}

/// Copies extended attributes, which include access control lists.
fn copy_attributes(path: &Path, twin: &File) -> io::Result<()> {
    use rustix::fs::{XattrFlags, fsetxattr, getxattr, getxattr_query, listxattr, listxattr_query};

    // A file system without this query has no attributes.
    let mut names = vec![0; listxattr_query(path).unwrap_or(0)];
    if names.is_empty() {
        return Ok(());
    }
    let length = listxattr(path, &mut names[..])?;
    for name in names[..length].split(|&byte| byte == 0) {
        if !name.is_empty() {
            let mut value = vec![0; getxattr_query(path, name)?];
            let length = getxattr(path, name, &mut value[..])?;
            call("setxattr", || {
                Ok(fsetxattr(
                    twin,
                    name,
                    &value[..length],
                    XattrFlags::empty(),
                )?)
            })?;
        }
    }
    Ok(())
}
