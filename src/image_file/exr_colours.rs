//! Reads the colours of `OpenEXR` pictures: the channels R, G and B, otherwise those of the first layer
//! that has colours, or the luminance, as grey.

use std::collections::HashMap;
use std::io::{BufReader, Read, Seek};

use exr::block::{self, reader::Reader};
use exr::error::Error;
use exr::image::read::image::ReadLayers;
use exr::image::read::layers::ReadFirstValidLayer;
use exr::image::read::specific_channels::ReadSpecificChannel;
use exr::image::{Layer, SpecificChannels};
use exr::meta::attribute::{Compression, Text};
use exr::meta::header::Header;
use exr::prelude::{Vec2, read};
use image::{DynamicImage, Rgb32FImage};

use super::input::Input;
use super::unreadable::{MAX_MEMORY, Unreadable, check_room, check_size, unsupported};
use scene::{Image, Size};

/// The name of the format in messages.
const NAME: &str = "OpenEXR";

/// The most channels of a part of a picture; the largest have some hundreds.
const MAX_CHANNELS: usize = 1024;

/// The channels of a layer by their names in it: of a layer `beauty`, R is `beauty.R`.
type Names<'h> = HashMap<String, &'h Text>;

/// The channels that hold the colours of a picture.
enum Channels {
    /// Red, green and blue, which a layer calls by names such as `beauty.R`.
    Colours([Text; 3]),
    /// The luminance, of the picture or of a layer.
    Luminance(Text),
}

/// Reads a picture with at most `room` pixels.
pub(super) fn read_colours(file: &mut dyn Input, room: u64) -> Result<Image, Unreadable> {
    let reader = block::read(BufReader::new(file), false).map_err(|error| unreadable(&error))?;
    let (header, channels) = chosen(reader.headers())?;
    match header.compression {
        Compression::DWAA(_) => return Err(unsupported(NAME, "DWAA compression")),
        Compression::DWAB(_) => return Err(unsupported(NAME, "DWAB compression")),
        Compression::HTJ2K32 | Compression::HTJ2K256 => {
            return Err(unsupported(NAME, "HTJ2K compression"));
        }
        _ => {}
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
    let black = move || vec![0_f32; values];
    let levels = read().no_deep_data().largest_resolution_level();
    let channel = levels.specific_channels();
    let pixels = match channels {
        Channels::Colours([red, green, blue]) => {
            let channels = channel
                .required(red)
                .required(green)
                .required(blue)
                .collect_pixels(
                    move |_, _| black(),
                    move |pixels, at, (r, g, b): (f32, f32, f32)| {
                        put(pixels, at, [r, g, b]);
                    },
                );
            collected(channels, reader)
        }
        Channels::Luminance(name) => {
            let channels = channel.required(name).collect_pixels(
                move |_, _| black(),
                move |pixels, at, (y,): (f32,)| put(pixels, at, [y; 3]),
            );
            collected(channels, reader)
        }
    };
    let pixels = pixels.map_err(|error| unreadable(&error))?;
    let image = Rgb32FImage::from_raw(size.width, size.height, pixels);
    // As of any picture with floating-point values.
    let image = image.map(|image| DynamicImage::ImageRgb32F(image).into_rgb8());
    let pixels = image.map(|image| image.pixels().map(|pixel| pixel.0).collect());
    pixels
        .and_then(|pixels| Image::new(size, pixels))
        .ok_or_else(|| Unreadable::Broken("it has no pixels".to_owned()))
}

/// The pixels that the channels of a part collect.
fn collected<C, D>(channels: C, reader: Reader<impl Read + Seek>) -> Result<Vec<f32>, Error>
where
    for<'s> ReadFirstValidLayer<C>: ReadLayers<'s, Layers = Layer<SpecificChannels<Vec<f32>, D>>>,
{
    let part = ReadFirstValidLayer {
        read_channels: channels,
    };
    let image = part.all_attributes().from_chunks(reader)?;
    Ok(image.layer_data.channel_data.pixels)
}

/// The part of a picture that has colours, and the channels that hold them.
fn chosen(headers: &[Header]) -> Result<(&Header, Channels), Unreadable> {
    let is_over = |header: &Header| MAX_CHANNELS < header.channels.list.len();
    if headers.iter().any(is_over) {
        let feature = format!("more than {MAX_CHANNELS} channels");
        return Err(unsupported(NAME, &feature));
    }
    let flat = headers.iter().filter(|header| !header.deep);
    let flat: Vec<_> = flat.map(|header| (header, layers(header))).collect();
    let plain = || {
        let parts = flat.iter();
        parts.filter_map(|(header, layers)| Some((*header, layers.first()?)))
    };
    let layers = || {
        let parts = flat.iter();
        parts.flat_map(|(header, layers)| layers.iter().map(move |layer| (*header, layer)))
    };
    let mut by_preference = plain().chain(layers());
    if let Some((header, names)) =
        by_preference.find_map(|(header, layer)| Some((header, colours(layer)?)))
    {
        return Ok((header, Channels::Colours(names.map(Text::clone))));
    }
    let luminance = layers().find_map(|(header, layer)| Some((header, layer, *layer.get("Y")?)));
    match luminance {
        Some((_, layer, _)) if layer.contains_key("RY") || layer.contains_key("BY") => {
            Err(unsupported(NAME, "luminance and chroma"))
        }
        Some((header, _, name)) => Ok((header, Channels::Luminance(name.clone()))),
        None if headers.iter().any(|header| header.deep) => Err(unsupported(NAME, "deep pixels")),
        None => Err(unsupported(NAME, "no channels R, G, B or Y")),
    }
}

/// The channels R, G and B of a layer, if it has them all.
fn colours<'h>(layer: &Names<'h>) -> Option<[&'h Text; 3]> {
    let channel = |name| layer.get(name).copied();
    Some([channel("R")?, channel("G")?, channel("B")?])
}

/// The layers of a part, each named by what stands before the last dot of its channels: first the one
/// without a name, then each in the order of its first channel.
fn layers(header: &Header) -> Vec<Names<'_>> {
    let mut layers = vec![Names::new()];
    let mut places = HashMap::from([(String::new(), 0)]);
    for channel in &header.channels.list {
        let name = channel.name.to_string();
        let (layer, own) = name.split_at(name.rfind('.').map_or(0, |dot| dot + 1));
        let place = *places.entry(layer.to_owned()).or_insert(layers.len());
        if place == layers.len() {
            layers.push(Names::new());
        }
        layers[place].insert(own.to_owned(), &channel.name);
    }
    layers
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
