//! Reads the pictures of textures.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::failure::{Failure, PictureErrors, Substitute};
use super::{Known, Load};
use image_file::Unreadable;
use scene::{Image, Images};

impl Load<'_> {
    /// Reads pictures. Returns also the errors of those that are missing or not up to date.
    pub(super) fn pictures(&mut self, names: &BTreeSet<String>) -> (Images, PictureErrors) {
        let mut images = Vec::new();
        let mut picture_errors = PictureErrors::new();
        for name in names {
            let place = self.gate.place(name);
            let image = match self.picture(name) {
                Ok(known) => Some(known),
                Err(failure) => {
                    let last = self.before.image_of(&place);
                    let last = last.filter(|(digest, image)| self.has_room(*digest, image));
                    let shown = match last {
                        Some(_) => Substitute::Last,
                        None => Substitute::Magenta,
                    };
                    picture_errors.insert(name.clone(), failure.picture_error(shown));
                    last
                }
            };
            if let Some((digest, image)) = image {
                images.push((name.clone(), Arc::clone(&image)));
                self.now.files.insert(place, digest);
                let pixels = image.size().pixels() as u64;
                if self.now.images.insert(digest, image).is_none() {
                    self.room.pixels -= pixels;
                }
            }
        }
        (images.into_iter().collect(), picture_errors)
    }

    /// Reads one picture. Returns it with the hash of its file.
    fn picture(&mut self, name: &str) -> Result<(u64, Arc<Image>), Failure> {
        let stream = self.stream(name)?;
        let digest = stream.digest;
        let known = self.now.images.get(&digest);
        let image = match known.or_else(|| self.before.images.get(&digest)) {
            Some(image) => Arc::clone(image),
            None => Arc::new(image_file::decode(&mut &stream.file, self.room.pixels)?),
        };
        if self.has_room(digest, &image) {
            Ok((digest, image))
        } else {
            Err(Failure::Unreadable(Unreadable::NoRoom))
        }
    }

    /// Whether a picture is already counted or fits into the remaining room.
    fn has_room(&self, digest: u64, image: &Image) -> bool {
        image.size().pixels() as u64 <= self.room.pixels || self.now.images.contains_key(&digest)
    }
}

impl Known {
    fn image_of(&self, place: &std::path::Path) -> Option<(u64, Arc<Image>)> {
        let digest = *self.files.get(place)?;
        Some((digest, Arc::clone(self.images.get(&digest)?)))
    }
}
