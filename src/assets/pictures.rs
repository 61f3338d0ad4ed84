//! The pictures of textures.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::trouble::{Failure, Shown, Troubles};
use super::{Known, Reading};
use crate::image_file::{self, Unreadable};
use crate::scene::{Image, Images};

impl Reading<'_> {
    /// Reads pictures; says which are not to be had, or not those of now.
    pub(super) fn pictures(&mut self, names: &BTreeSet<String>) -> (Images, Troubles) {
        let mut images = Vec::new();
        let mut troubles = Troubles::new();
        for name in names {
            let place = self.gate.place(name);
            let image = match self.picture(name) {
                Ok(known) => Some(known),
                Err(failure) => {
                    let last = self.before.image_of(&place);
                    let last = last.filter(|(print, image)| self.has_room(*print, image));
                    let shown = match last {
                        Some(_) => Shown::Last,
                        None => Shown::Magenta,
                    };
                    troubles.insert(name.clone(), failure.trouble(shown));
                    last
                }
            };
            if let Some((print, image)) = image {
                images.push((name.clone(), Arc::clone(&image)));
                self.now.files.insert(place, print);
                let pixels = image.size().pixels() as u64;
                if self.now.images.insert(print, image).is_none() {
                    self.room.pixels -= pixels;
                }
            }
        }
        (images.into_iter().collect(), troubles)
    }

    /// Reads one picture: what stands for its bytes, and itself.
    fn picture(&mut self, name: &str) -> Result<(u64, Arc<Image>), Failure> {
        let stream = self.stream(name)?;
        let print = stream.print;
        let known = self.now.images.get(&print);
        let image = match known.or_else(|| self.before.images.get(&print)) {
            Some(image) => Arc::clone(image),
            None => Arc::new(image_file::decode(&stream.file, self.room.pixels)?),
        };
        if self.has_room(print, &image) {
            Ok((print, image))
        } else {
            Err(Failure::Unreadable(Unreadable::NoRoom))
        }
    }

    /// Whether a picture is among those read, or fits beside them.
    fn has_room(&self, print: u64, image: &Image) -> bool {
        image.size().pixels() as u64 <= self.room.pixels || self.now.images.contains_key(&print)
    }
}

impl Known {
    fn image_of(&self, place: &std::path::Path) -> Option<(u64, Arc<Image>)> {
        let print = *self.files.get(place)?;
        Some((print, Arc::clone(self.images.get(&print)?)))
    }
}
