//! The colours of heat maps.

use scene::Rgb;

/// Inferno, at equal steps: dark to bright, perceptually uniform, distinct without red or green
/// vision and in grey (Smith and van der Walt, "A Better Default Colormap for Matplotlib", 2015).
const INFERNO: [[u8; 3]; 17] = [
    [0, 0, 4],
    [11, 7, 36],
    [33, 12, 74],
    [61, 9, 101],
    [87, 16, 110],
    [113, 25, 110],
    [138, 34, 106],
    [163, 44, 97],
    [188, 55, 84],
    [210, 70, 68],
    [228, 90, 49],
    [241, 115, 29],
    [249, 142, 9],
    [252, 172, 17],
    [249, 203, 53],
    [242, 234, 105],
    [252, 255, 164],
];

/// The displayed colour of a share of the scale, clamped to 0 to 1; NaN is 0.
pub(crate) fn heat(share: f64) -> Rgb {
    let place = share.clamp(0.0, 1.0).max(0.0) * (INFERNO.len() - 1) as f64;
    let below = (place as usize).min(INFERNO.len() - 2);
    let [low, high] = [below, below + 1].map(|at| Rgb::from(INFERNO[at].map(f64::from)));
    low.lerp(high, place - below as f64) / 255.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_rises_from_dark_to_bright() {
        let luminances: Vec<f64> = (0..=64)
            .map(|step| heat(f64::from(step) / 64.0).dot(Rgb::new(0.2126, 0.7152, 0.0722)))
            .collect();
        assert!(luminances.is_sorted_by(|a, b| a < b));
        for (share, colour) in [
            (0.0, [0, 0, 4]),
            (0.5, [188, 55, 84]),
            (1.0, [252, 255, 164]),
        ] {
            assert_eq!(heat(share), Rgb::from(colour.map(f64::from)) / 255.0);
        }
        assert_eq!(heat(f64::NAN), heat(0.0));
        assert_eq!(heat(f64::INFINITY), heat(1.0));
        assert_eq!(heat(-1.0), heat(0.0));
    }
}
