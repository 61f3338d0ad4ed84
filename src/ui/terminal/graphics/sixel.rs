//! Sixel: pictures in 256 colours, as bands of six rows (DEC STD 070, section 6; xterm's `ctlseqs`).
//!
//! Colours are chosen by repeatedly dividing the box with the greatest squared error at the mean of
//! its widest axis, in a histogram of 65,536 bins. The `icy_sixel` crate, which clusters all pixels
//! and dithers, needs many times as long for a frame and brings 20 crates; its pictures are meant to
//! be encoded once.

use std::ops::Range;

use super::pixmap::Pixmap;

/// The most colours of a picture: what terminals have registers for.
const MOST: usize = 256;

/// Bits of a channel in the histogram.
const BITS: [u32; 3] = [5, 6, 5];

/// Height of a band, in pixels.
const BAND: usize = 6;

/// Appends a picture as a sixel sequence that fills `width`×`height` pixels, by repeating pixels if
/// there are fewer. Equal pictures give equal bytes.
pub(super) fn encode(pixmap: &Pixmap, (width, height): (usize, usize), out: &mut Vec<u8>) {
    let (indices, palette) = quantized(&pixmap.pixels);
    // Pixels without a colour stay as they are: those below the picture in the last band.
    out.extend_from_slice(format!("\x1bP0;1;0q\"1;1;{width};{height}").as_bytes());
    for (index, colour) in palette.iter().enumerate() {
        let [red, green, blue] = colour.map(percent);
        out.extend_from_slice(format!("#{index};2;{red};{green};{blue}").as_bytes());
    }
    let (columns, rows) = (pixmap.size.width as usize, pixmap.size.height as usize);
    let source: Vec<usize> = (0..width).map(|x| x * columns / width).collect();
    let mut band = Band::new(width);
    for top in (0..height).step_by(BAND) {
        for y in top..height.min(top + BAND) {
            let row = &indices[y * rows / height * columns..][..columns];
            for (x, &from) in source.iter().enumerate() {
                band.set(row[from], x, y - top);
            }
        }
        if 0 < top {
            out.push(b'-');
        }
        band.flush(out);
    }
    out.extend_from_slice(b"\x1b\\");
}

/// A channel in percent, the unit of sixel colours.
fn percent(channel: u8) -> u32 {
    (u32::from(channel) * 100 + 127) / 255
}

/// Six rows of pixels, by colour.
struct Band {
    width: usize,
    /// For each colour and column, the pixels that have the colour, from the lowest bit.
    bits: Vec<u8>,
    /// The columns in which each colour occurs.
    extents: Vec<Range<usize>>,
    /// The colours that occur.
    used: Vec<u8>,
}

impl Band {
    fn new(width: usize) -> Self {
        Self {
            width,
            bits: vec![0; MOST * width],
            extents: vec![0..0; MOST],
            used: Vec::new(),
        }
    }

    fn set(&mut self, colour: u8, x: usize, y: usize) {
        self.bits[usize::from(colour) * self.width + x] |= 1 << y;
        let extent = &mut self.extents[usize::from(colour)];
        if extent.start == extent.end {
            *extent = x..x + 1;
            self.used.push(colour);
        } else {
            extent.start = extent.start.min(x);
            extent.end = extent.end.max(x + 1);
        }
    }

    /// Appends the band and clears it. Colours that do not overlap share a pass over the columns.
    fn flush(&mut self, out: &mut Vec<u8>) {
        let extents = &self.extents;
        self.used
            .sort_unstable_by_key(|&colour| (extents[usize::from(colour)].start, colour));
        let mut waiting = std::mem::take(&mut self.used);
        let mut is_first = true;
        while !waiting.is_empty() {
            if !is_first {
                out.push(b'$');
            }
            is_first = false;
            let mut column = 0;
            waiting.retain(|&colour| {
                let extent = self.extents[usize::from(colour)].clone();
                let waits = extent.start < column;
                if !waits {
                    out.extend_from_slice(format!("#{colour}").as_bytes());
                    repeat(0, extent.start - column, out);
                    column = extent.end;
                    self.emit(colour, extent, out);
                }
                waits
            });
        }
    }

    /// Appends the columns of a colour and clears them.
    fn emit(&mut self, colour: u8, extent: Range<usize>, out: &mut Vec<u8>) {
        let start = usize::from(colour) * self.width;
        let bits = &mut self.bits[start + extent.start..start + extent.end];
        for run in bits.chunk_by(|a, b| a == b) {
            repeat(run[0], run.len(), out);
        }
        bits.fill(0);
        self.extents[usize::from(colour)] = 0..0;
    }
}

/// Appends columns with the same pixels.
fn repeat(bits: u8, count: usize, out: &mut Vec<u8>) {
    let character = b'?' + bits;
    if count < 4 {
        out.extend(std::iter::repeat_n(character, count));
    } else {
        out.extend_from_slice(format!("!{count}").as_bytes());
        out.push(character);
    }
}

/// The pixels of a bin of the histogram, or of several.
#[derive(Clone, Copy, Debug, Default)]
struct Bin {
    count: u32,
    sums: [u32; 3],
}

impl Bin {
    fn mean(&self) -> [f32; 3] {
        self.sums.map(|sum| sum as f32 / self.count as f32)
    }
}

/// The bin of a colour.
fn bin_of(pixel: [u8; 3]) -> usize {
    let channels = pixel.iter().zip(BITS);
    channels.fold(0, |bin, (&channel, bits)| {
        bin << bits | usize::from(channel) >> (8 - bits)
    })
}

/// Some bins, and the squared error if all are shown in their mean colour.
struct Cluster {
    bins: Range<usize>,
    error: f32,
    mean: [f32; 3],
    /// The channel with the greatest error.
    axis: usize,
}

impl Cluster {
    fn of(bins: Range<usize>, all: &[(usize, Bin)]) -> Self {
        let (mut count, mut sums, mut squares) = (0.0, [0.0; 3], [0.0; 3]);
        for (_, bin) in &all[bins.clone()] {
            let mean = bin.mean();
            count += f64::from(bin.count);
            for channel in 0..3 {
                let sum = f64::from(bin.sums[channel]);
                sums[channel] += sum;
                squares[channel] += sum * f64::from(mean[channel]);
            }
        }
        let mean = sums.map(|sum: f64| sum / count);
        let errors =
            [0, 1, 2].map(|channel: usize| squares[channel] - sums[channel] * mean[channel]);
        let axis = (0..3).max_by(|&a, &b| errors[a].total_cmp(&errors[b]));
        Self {
            // One bin cannot be divided.
            error: if bins.len() == 1 {
                0.0
            } else {
                errors.iter().sum::<f64>() as f32
            },
            bins,
            mean: mean.map(|mean| mean as f32),
            axis: axis.unwrap_or(0),
        }
    }

    /// Divides the cluster in two that are not empty, if its bins differ at all.
    fn divided(&self, all: &mut [(usize, Bin)]) -> Option<[Self; 2]> {
        let bins = &mut all[self.bins.clone()];
        let mut below = 0;
        for at in 0..bins.len() {
            if bins[at].1.mean()[self.axis] < self.mean[self.axis] {
                bins.swap(at, below);
                below += 1;
            }
        }
        let middle = self.bins.start + below;
        let halves = [self.bins.start..middle, middle..self.bins.end];
        (!halves.iter().any(Range::is_empty)).then(|| halves.map(|half| Self::of(half, all)))
    }
}

/// Returns the index of each pixel in a palette, and the palette.
fn quantized(pixels: &[[u8; 3]]) -> (Vec<u8>, Vec<[u8; 3]>) {
    let mut histogram = vec![Bin::default(); 1 << BITS.iter().sum::<u32>()];
    for &pixel in pixels {
        let bin = &mut histogram[bin_of(pixel)];
        bin.count += 1;
        for (sum, channel) in bin.sums.iter_mut().zip(pixel) {
            *sum += u32::from(channel);
        }
    }
    let occupied = histogram.into_iter().enumerate();
    let mut bins: Vec<_> = occupied.filter(|(_, bin)| 0 < bin.count).collect();
    let mut indices = vec![0; 1 << BITS.iter().sum::<u32>()];
    let clusters = clusters(&mut bins).into_iter().enumerate();
    let palette = clusters.map(|(index, cluster)| {
        for (bin, _) in &bins[cluster.bins] {
            indices[*bin] = index as u8;
        }
        cluster.mean.map(|channel| channel.round() as u8)
    });
    let palette = palette.collect();
    let indices = pixels.iter().map(|&pixel| indices[bin_of(pixel)]).collect();
    (indices, palette)
}

/// Divides bins into clusters with little error.
fn clusters(bins: &mut [(usize, Bin)]) -> Vec<Cluster> {
    let mut clusters = Vec::with_capacity(MOST);
    if bins.is_empty() {
        return clusters;
    }
    clusters.push(Cluster::of(0..bins.len(), bins));
    while clusters.len() < MOST {
        let errors = clusters.iter().enumerate();
        let worst = errors.max_by(|(_, a), (_, b)| a.error.total_cmp(&b.error));
        let Some((worst, cluster)) = worst.filter(|(_, cluster)| 0.0 < cluster.error) else {
            break;
        };
        match cluster.divided(bins) {
            Some([lower, upper]) => {
                clusters[worst] = lower;
                clusters.push(upper);
            }
            // Differences lost to rounding.
            None => clusters[worst].error = 0.0,
        }
    }
    clusters
}
