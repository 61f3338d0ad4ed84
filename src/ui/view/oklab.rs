//! Perceptual colour: linear light from sRGB bytes, and `OkLab` from linear light (B. Ottosson, “A
//! perceptual color space for image processing”, 2020).

/// Converts an 8-bit sRGB colour to linear red, green and blue, each from 0 to 1.
pub(super) fn light(colour: [u8; 3]) -> [f32; 3] {
    colour.map(|channel| {
        let value = f32::from(channel) / 255.0;
        if value <= 0.04045 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        }
    })
}

/// Converts linear light to `OkLab`, whose distances approximate perceived ones: lightness from 0
/// to 1, then the two chromatic axes.
pub(super) fn oklab(light: [f32; 3]) -> [f32; 3] {
    let times = |rows: [[f32; 3]; 3], of: [f32; 3]| {
        rows.map(|row| row[0] * of[0] + row[1] * of[1] + row[2] * of[2])
    };
    let cones = times(
        [
            [0.412_221_47, 0.536_332_54, 0.051_445_995],
            [0.211_903_5, 0.680_699_5, 0.107_396_96],
            [0.088_302_46, 0.281_718_85, 0.629_978_7],
        ],
        light,
    );
    times(
        [
            [0.210_454_26, 0.793_617_8, -0.004_072_047],
            [1.977_998_5, -2.428_592_2, 0.450_593_7],
            [0.025_904_037, 0.782_771_77, -0.808_675_77],
        ],
        cones.map(f32::cbrt),
    )
}

/// The luma of an 8-bit colour, from 0 to 255, with the weights of Rec. 709.
pub(super) fn luma([red, green, blue]: [u8; 3]) -> f32 {
    0.2126 * f32::from(red) + 0.7152 * f32::from(green) + 0.0722 * f32::from(blue)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_and_red_have_their_published_coordinates() {
        for (colour, known) in [
            ([255, 255, 255], [1.0, 0.0, 0.0]),
            ([255, 0, 0], [0.628, 0.225, 0.126]),
        ] {
            let lab = oklab(light(colour));
            for (value, known) in lab.into_iter().zip(known) {
                assert!((value - known).abs() < 1e-3, "{colour:?}: {lab:?}");
            }
        }
    }
}
