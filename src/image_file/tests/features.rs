//! What files may hold that is read in a way of its own, or cannot be read.

use super::*;

/// An EXR of two pixels with these channels, each with two values.
fn exr_of(channels: &[(&str, [f32; 2])]) -> Vec<u8> {
    use ::exr::prelude::*;
    let channel = |(name, values): &(&str, [f32; 2])| {
        AnyChannel::new(*name, FlatSamples::F32(values.to_vec()))
    };
    let layer = Layer::new(
        Vec2(2, 1),
        LayerAttributes::default(),
        Encoding::UNCOMPRESSED,
        AnyChannels::sort(channels.iter().map(channel).collect()),
    );
    let mut bytes = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().to_buffered(&mut bytes);
    written.expect("memory takes all");
    bytes.into_inner()
}

#[test]
fn an_exr_has_its_colours_in_the_first_place_that_holds_any() {
    let (red, green, blue) = ([1.0, 0.0], [0.0, 1.0], [0.0, 0.0]);
    let other = [0.0, 0.0];
    let coloured = vec![[255, 0, 0], [0, 255, 0]];
    let grey = vec![[255; 3], [0; 3]];
    for (channels, expected) in [
        (&[("R", red), ("G", green), ("B", blue)][..], &coloured),
        (
            &[
                ("R", red),
                ("G", green),
                ("B", blue),
                ("Y", other),
                ("A", other),
            ],
            &coloured,
        ),
        (&[("b.R", red), ("b.G", green), ("b.B", blue)], &coloured),
        (
            &[
                ("a.Z", other),
                ("b.R", red),
                ("b.G", green),
                ("b.B", blue),
                ("c.R", other),
                ("c.G", other),
                ("c.B", other),
                ("Y", other),
            ],
            &coloured,
        ),
        (
            &[("v.b.R", red), ("v.b.G", green), ("v.b.B", blue)],
            &coloured,
        ),
        (&[("Y", red)], &grey),
        (&[("Y", red), ("A", other)], &grey),
        (&[("a.Z", other), ("b.Y", red)], &grey),
        (
            &[("a.R", other), ("b.G", other), ("c.B", other), ("d.Y", red)],
            &grey,
        ),
    ] {
        let image =
            decode(&exr_of(channels)).unwrap_or_else(|error| panic!("{channels:?}: {error}"));
        assert_eq!(image.pixels(), &expected[..], "{channels:?}");
    }
}

#[test]
fn what_an_exr_has_that_cannot_be_read_is_named() {
    let compressed = |number: u8| {
        let mut bytes = exr_of(&[("R", [0.0; 2]), ("G", [0.0; 2]), ("B", [0.0; 2])]);
        let name = b"compression\0compression\0";
        let at = bytes.windows(name.len()).position(|window| window == name);
        bytes[at.expect("it has it") + name.len() + 4] = number;
        bytes
    };
    let many = |count: usize| {
        let names: Vec<_> = (0..count).map(|number| format!("{number}.A")).collect();
        let channels = names.iter().map(|name| (name.as_str(), [0.0; 2]));
        exr_of(&channels.collect::<Vec<_>>())
    };
    for (bytes, feature) in [
        (compressed(8), "DWAA compression"),
        (compressed(9), "DWAB compression"),
        (compressed(10), "HTJ2K compression"),
        (compressed(11), "HTJ2K compression"),
        (compressed(99), "unknown compression"),
        (
            exr_of(&[("Y", [0.0; 2]), ("RY", [0.0; 2]), ("BY", [0.0; 2])]),
            "luminance and chroma",
        ),
        (exr_of(&[("Z", [0.0; 2])]), "no channels R, G, B or Y"),
        (many(1024), "no channels R, G, B or Y"),
        (many(1025), "more than 1024 channels"),
    ] {
        let refused = decode(&bytes).expect_err(feature);
        let expected = format!("is an unsupported kind of OpenEXR ({feature})");
        assert_eq!(refused.to_string(), expected);
    }
}

#[test]
fn any_program_may_have_written_a_radiance_hdr() {
    let bytes = encoded(ImageFormat::Hdr, &bright());
    let expected = decode(&bytes).expect("a picture");
    let rest = bytes.strip_prefix(b"#?RADIANCE\n").expect("its first line");
    for first in ["#?RGBE\n", "#?AUTOPANO-SIFT-C x\n", "#?\n"] {
        let renamed = [first.as_bytes(), rest].concat();
        assert_eq!(decode(&renamed).expect(first), expected);
    }
    for broken in [&b"#?RGBE"[..], b"#?RGBE\n", b"#?RGBE\n\n"] {
        assert!(decode(broken).is_err(), "{broken:?}");
    }
}
