//! Reads the colours of `OpenEXR` pictures whose channels are not called R, G and B: those of the first
//! layer that has colours, or the luminance, as grey.

use std::io::{BufReader, Read, Seek};

use exr::block;
use exr::error::Error;
use exr::image::read::specific_channels::ReadSpecificChannel;
use exr::meta::attribute::{Compression, Text};
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers, Vec2, read};
use image::{DynamicImage, Rgb32FImage};

use super::unreadable::{MAX_MEMORY, Unreadable, check_room, check_size, unsupported};
use crate::scene::{Image, Size};

/// The name of the format in messages.
const NAME: &str = "OpenEXR";

/// The channels that hold the colours of a picture.
enum Channels {
    /// R, G and B.
    Plain,
    /// Those of a layer, such as `beauty.R`.
    Layer([Text; 3]),
    /// The luminance, of the picture or of a layer.
    Luminance(Text),
}

/// Reads a picture with at most `room` pixels; `None` if its colours are in R, G and B.
pub(super) fn read_colours(
    file: &mut (impl Read + Seek),
    room: u64,
) -> Result<Option<Image>, Unreadable> {
    let reader = block::read(BufReader::new(file), false).map_err(|error| unreadable(&error))?;
    let (header, channels) = chosen(reader.headers())?;
    if matches!(
        header.compression,
        Compression::HTJ2K32 | Compression::HTJ2K256
    ) {
        return Err(unsupported(NAME, "HTJ2K compression"));
    }
    let window = header.shared_attributes.display_window;
    let size = Size {
        width: window.size.width() as u32,
        height: window.size.height() as u32,
    };
    check_size(size, room)?;
    let values = size.pixels().saturating_mul(3);
    if MAX_MEMORY < values.saturating_mul(size_of::<f32>()) as u64 {
        return Err(Unreadable::NoMemory);
    }
    check_room(size, (values * size_of::<f32>()) as u64)?;
    let offset = header.own_attributes.layer_position - window.position;
    // Pixels outside the display window are not shown.
    let put = move |pixels: &mut Vec<f32>, at: Vec2<usize>, colour: [f32; 3]| {
        let at = at.to_i32() + offset;
        let (x, y) = (u32::try_from(at.x()), u32::try_from(at.y()));
        if let (Ok(x), Ok(y)) = (x, y)
            && x < size.width
            && y < size.height
        {
            let at = y as usize * size.width as usize + x as usize;
            pixels[3 * at..][..3].copy_from_slice(&colour);
        }
    };
    let levels = read().no_deep_data().largest_resolution_level();
    let channel = levels.specific_channels();
    let pixels = match channels {
        Channels::Plain => return Ok(None),
        Channels::Layer([red, green, blue]) => channel
            .required(red)
            .required(green)
            .required(blue)
            .collect_pixels(
                move |_, _| vec![0_f32; values],
                move |pixels, at, (r, g, b): (f32, f32, f32)| put(pixels, at, [r, g, b]),
            )
            .first_valid_layer()
            .all_attributes()
            .from_chunks(reader)
            .map(|image| image.layer_data.channel_data.pixels),
        Channels::Luminance(name) => channel
            .required(name)
            .collect_pixels(
                move |_, _| vec![0_f32; values],
                move |pixels, at, (y,): (f32,)| put(pixels, at, [y; 3]),
            )
            .first_valid_layer()
            .all_attributes()
            .from_chunks(reader)
            .map(|image| image.layer_data.channel_data.pixels),
    };
    let pixels = pixels.map_err(|error| unreadable(&error))?;
    let image = Rgb32FImage::from_raw(size.width, size.height, pixels);
    // As of any picture with floating-point values.
    let image = image.map(|image| DynamicImage::ImageRgb32F(image).into_rgb8());
    let pixels = image.map(|image| image.pixels().map(|pixel| pixel.0).collect());
    pixels
        .and_then(|pixels| Image::new(size, pixels))
        .map(Some)
        .ok_or_else(|| Unreadable::Broken("it has no pixels".to_owned()))
}

/// The part of a picture that has colours, and the channels that hold them.
fn chosen(headers: &[Header]) -> Result<(&Header, Channels), Unreadable> {
    let flat = || headers.iter().filter(|header| !header.deep);
    let has = |header: &Header, name: &Text| header.channels.find_index_of_channel(name).is_some();
    let plain = ["R", "G", "B"].map(Text::from);
    if let Some(header) = flat().find(|header| plain.iter().all(|name| has(header, name))) {
        return Ok((header, Channels::Plain));
    }
    let layers = || flat().flat_map(|header| layers(header).map(move |layer| (header, layer)));
    let channel = |layer: &str, name: &str| Text::from(format!("{layer}{name}").as_str());
    for (header, layer) in layers() {
        let names = ["R", "G", "B"].map(|name| channel(&layer, name));
        if names.iter().all(|name| has(header, name)) {
            return Ok((header, Channels::Layer(names)));
        }
    }
    for (header, layer) in layers() {
        let [name, red, blue] = ["Y", "RY", "BY"].map(|name| channel(&layer, name));
        if !has(header, &name) {
            continue;
        }
        if has(header, &red) || has(header, &blue) {
            return Err(unsupported(NAME, "luminance and chroma"));
        }
        return Ok((header, Channels::Luminance(name)));
    }
    Err(unsupported(
        NAME,
        if headers.iter().any(|header| header.deep) {
            "deep pixels"
        } else {
            "no channels R, G, B or Y"
        },
    ))
}

/// What stands before the names of channels, such as `beauty.`: first nothing, then each layer in the
/// order of its first channel.
fn layers(header: &Header) -> impl Iterator<Item = String> {
    let names = header.channels.list.iter();
    let names = names.map(|channel| channel.name.to_string());
    let mut layers = vec![String::new()];
    for name in names {
        if let Some(dot) = name.rfind('.')
            && !layers.iter().any(|layer| *layer == name[..=dot])
        {
            layers.push(name[..=dot].to_owned());
        }
    }
    layers.into_iter()
}

/// Translates an error of the decoder.
pub(super) fn unreadable(error: &Error) -> Unreadable {
    match error {
        Error::NotSupported(what) if what.contains("subsampling") => {
            unsupported(NAME, "subsampled channels")
        }
        Error::NotSupported(what) if what.contains("compression") => {
            unsupported(NAME, "unknown compression")
        }
        Error::NotSupported(what) if what.contains("deep") => unsupported(NAME, "deep pixels"),
        Error::NotSupported(_) => unsupported(NAME, ""),
        Error::Io(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            Unreadable::Broken("it is truncated".to_owned())
        }
        Error::Io(error) => Unreadable::Broken(error.to_string()),
        Error::Invalid(_) | Error::Aborted => {
            Unreadable::Broken(format!("its {NAME} data is damaged"))
        }
    }
}
