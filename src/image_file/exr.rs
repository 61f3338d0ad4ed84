//! `OpenEXR`: floating-point pictures with layers.

use std::io::{Cursor, Write};

use exr::error::Error;
use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
use exr::math::Vec2;
use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::LayerAttributes;

use super::metadata;
use super::picture::Picture;
use render::{Aov, Frame};
use scene::Size;

/// Encodes in memory: the file begins with a table of offsets.
///
/// The light has the channels R, G and B; a layer has its AOV's name before those of its channels, as
/// `normal.X`, which programs that know layers take apart.
pub(super) fn write(picture: Picture<'_>, out: &mut impl Write) -> Result<(), Error> {
    let size = picture.frame.size;
    let mut channels = channels("", &["R", "G", "B"], picture.frame);
    for (aov, frame) in picture.layers {
        let prefix = format!("{}.", aov.name());
        channels.extend(self::channels(&prefix, channel_names(*aov), frame));
    }
    let mut attributes = LayerAttributes::default();
    if let Some(provenance) = picture.provenance {
        let software = format!("Halflight {}", provenance.version);
        attributes.software_name = Some(Text::from(software.as_str()));
        let text = AttributeValue::Text(Text::from(metadata::text(provenance).as_str()));
        // With a second entry, their order in the file would be random.
        attributes.other.insert(Text::from(metadata::KEYWORD), text);
    }
    let layer = Layer::new(
        Vec2(size.width as usize, size.height as usize),
        attributes,
        Encoding::FAST_LOSSLESS,
        AnyChannels::sort(channels.into_iter().collect()),
    );
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes)?;
    out.write_all(bytes.get_ref()).map_err(Error::Io)
}

/// About how many bytes of memory a layer of this size takes, with those of its frame, until its
/// picture is written: its channels are copied, and encoded in memory.
pub fn layer_bytes(aov: Aov, size: Size) -> u64 {
    let frame = size_of::<[u8; 3]>() + size_of::<[f32; 3]>();
    let channels = channel_names(aov).len() * size_of::<f32>();
    (size.pixels() as u64).saturating_mul((frame + 2 * channels) as u64)
}

/// The names of an AOV's channels, as other programs call them.
fn channel_names(aov: Aov) -> &'static [&'static str] {
    match aov {
        Aov::Depth => &["Z"],
        Aov::Normal => &["X", "Y", "Z"],
        Aov::Uv => &["U", "V"],
        Aov::Albedo | Aov::Direct(_) | Aov::Emission | Aov::Indirect => &["R", "G", "B"],
        Aov::Object | Aov::Side | Aov::Cost | Aov::Samples | Aov::Noise => &["V"],
    }
}

fn channels(prefix: &str, names: &[&str], frame: &Frame) -> Vec<AnyChannel<FlatSamples>> {
    let channel = |(at, name): (usize, &&str)| {
        let values = frame.values.iter().map(|value| value[at]).collect();
        let name = format!("{prefix}{name}");
        AnyChannel::new(name.as_str(), FlatSamples::F32(values))
    };
    names.iter().enumerate().map(channel).collect()
}
