//! Small pictures for documents.

use compare::heat_map;
use image_file::encode_quickly;
use scene::{Image, Size};
use text::base64;

/// The largest size of a small picture.
const MOST: Size = Size {
    width: 160,
    height: 120,
};

/// A small picture as the address of its data.
#[derive(Clone)]
pub(super) struct Thumbnail {
    pub(super) size: Size,
    pub(super) address: String,
}

/// A submission, and where it differs, if it has the size of the reference.
pub(super) struct Thumbnails {
    pub(super) own: Option<Thumbnail>,
    pub(super) difference: Option<Thumbnail>,
}

impl Thumbnails {
    pub(super) fn of(own: &Image, reference: &Image) -> Self {
        let difference = (own.size() == reference.size()).then(|| {
            let heat = heat_map(reference.pixels(), own.pixels());
            // A single pixel that differs stays visible.
            Thumbnail::of(own.size(), &heat, brightest)
        });
        Self {
            own: Thumbnail::mean_of(own),
            difference: difference.flatten(),
        }
    }
}

impl Thumbnail {
    /// A picture made small, each pixel the mean of those that it stands for.
    pub(super) fn mean_of(image: &Image) -> Option<Self> {
        Self::of(image.size(), image.pixels(), mean)
    }

    fn of(
        size: Size,
        pixels: &[[u8; 3]],
        combined: fn(&mut dyn Iterator<Item = [u8; 3]>) -> [u8; 3],
    ) -> Option<Self> {
        let small = fitted(size);
        let span = |at: u32, of: u32, whole: u32| {
            let edge = |at: u32| u64::from(at) * u64::from(whole) / u64::from(of);
            edge(at) as usize..(edge(at + 1).max(edge(at) + 1)) as usize
        };
        let places = (0..small.height).flat_map(|y| (0..small.width).map(move |x| (x, y)));
        let made = places.map(|(x, y)| {
            let columns = span(x, small.width, size.width);
            let rows = span(y, small.height, size.height);
            let mut under = rows.flat_map(|row| {
                let row = &pixels[row * size.width as usize..];
                row[columns.clone()].iter().copied()
            });
            combined(&mut under)
        });
        let made: Vec<_> = made.collect();
        let png = encode_quickly(small, &made).ok()?;
        Some(Self {
            size: small,
            address: format!("data:image/png;base64,{}", base64(&png)),
        })
    }
}

/// The size of a picture once made small; small ones stay as they are.
fn fitted(size: Size) -> Size {
    let scale = |side: u32, most: u32| f64::from(most) / f64::from(side);
    let scale = scale(size.width, MOST.width).min(scale(size.height, MOST.height));
    let fitted = |side: u32| ((f64::from(side) * scale.min(1.0)).round() as u32).max(1);
    Size {
        width: fitted(size.width),
        height: fitted(size.height),
    }
}

fn mean(pixels: &mut dyn Iterator<Item = [u8; 3]>) -> [u8; 3] {
    let mut sums = [0_u64; 3];
    let mut count = 0;
    for pixel in pixels {
        for (sum, level) in sums.iter_mut().zip(pixel) {
            *sum += u64::from(level);
        }
        count += 1;
    }
    sums.map(|sum| (sum / count.max(1)) as u8)
}

fn brightest(pixels: &mut dyn Iterator<Item = [u8; 3]>) -> [u8; 3] {
    let sum = |pixel: &[u8; 3]| pixel.iter().map(|level| u16::from(*level)).sum::<u16>();
    pixels.max_by_key(sum).unwrap_or_default()
}
