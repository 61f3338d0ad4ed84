//! The terminal's pen: the colours and attributes of the next character, changed by as few bytes as
//! possible.

use ratatui::style::Modifier;

use super::colour::Ink;

/// Attributes that are visible on an empty cell.
pub(super) const VISIBLE_ON_BLANK: Modifier = Modifier::REVERSED
    .union(Modifier::UNDERLINED)
    .union(Modifier::SLOW_BLINK)
    .union(Modifier::RAPID_BLINK)
    .union(Modifier::CROSSED_OUT);

/// The style that a character needs; a colour is `None` if it is not visible.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    pub(super) fg: Option<Ink>,
    pub(super) bg: Option<Ink>,
    pub(super) modifier: Modifier,
    /// Attributes that may be on or off, regardless of `modifier`.
    pub(super) indifferent: Modifier,
}

impl Style {
    /// A style in which everything is visible.
    pub(super) const fn exactly(fg: Ink, bg: Ink, modifier: Modifier) -> Self {
        Self {
            fg: Some(fg),
            bg: Some(bg),
            modifier,
            indifferent: Modifier::empty(),
        }
    }

    /// The style of an empty cell.
    pub(super) const fn blank(bg: Ink) -> Self {
        Self {
            fg: None,
            bg: Some(bg),
            modifier: Modifier::empty(),
            indifferent: VISIBLE_ON_BLANK.complement(),
        }
    }

    /// The style of a cell that its character fills.
    pub(super) const fn solid(fg: Ink) -> Self {
        Self {
            bg: None,
            ..Self::exactly(fg, fg, Modifier::empty())
        }
    }
}

/// The known state of the terminal's pen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pen {
    fg: Ink,
    bg: Ink,
    modifier: Modifier,
    /// Whether this is the state of the terminal: another program may have used it.
    is_known: bool,
}

impl Pen {
    /// An unknown state, which is reset on first use.
    pub(super) const UNKNOWN: Self = Self {
        fg: Ink::Default,
        bg: Ink::Default,
        modifier: Modifier::empty(),
        is_known: false,
    };

    /// Resets the pen to the terminal's defaults.
    pub(super) fn reset(&mut self, out: &mut Vec<u8>) {
        out.extend_from_slice(b"\x1b[m");
        *self = Self {
            is_known: true,
            ..Self::UNKNOWN
        };
    }

    /// Returns the number of bytes needed to set the colours of a style, excluding the frame of the
    /// sequence.
    pub(super) fn colour_cost(&self, style: &Style) -> usize {
        let cost = |wanted: Option<Ink>, current| match wanted {
            Some(ink) if ink != current => ink_length(ink),
            _ => 0,
        };
        match (cost(style.fg, self.fg), cost(style.bg, self.bg)) {
            (0, 0) => 0,
            (0, one) | (one, 0) => one + 3,
            (fg, bg) => fg + bg + 4,
        }
    }

    /// Sets the pen for a character, sending only the differences.
    pub(super) fn apply(&mut self, style: &Style, out: &mut Vec<u8>) {
        if !self.is_known {
            self.reset(out);
        }
        let kept = self.modifier & style.indifferent;
        let modifier = (style.modifier - style.indifferent) | kept;
        let wanted = Self {
            fg: style.fg.unwrap_or(self.fg),
            bg: style.bg.unwrap_or(self.bg),
            modifier,
            is_known: true,
        };
        if wanted.is_plain() && !self.is_plain() {
            return self.reset(out);
        }
        let mut sequence = Sequence { out, parameters: 0 };
        attributes(self.modifier, wanted.modifier, &mut sequence);
        if wanted.fg != self.fg {
            ink_parameters(wanted.fg, 30, &mut sequence);
        }
        if wanted.bg != self.bg {
            ink_parameters(wanted.bg, 40, &mut sequence);
        }
        if sequence.parameters != 0 {
            out.push(b'm');
        }
        *self = wanted;
    }

    fn is_plain(&self) -> bool {
        self.fg == Ink::Default && self.bg == Ink::Default && self.modifier.is_empty()
    }
}

/// Writes a decimal number. Nearly all are components of colours, and a picture has thousands.
#[inline]
pub(super) fn push_number(out: &mut Vec<u8>, number: u16) {
    let digit = |place: u16| b'0' + (number / place % 10) as u8;
    match number {
        0..10 => out.push(digit(1)),
        10..100 => out.extend_from_slice(&[digit(10), digit(1)]),
        100..1000 => out.extend_from_slice(&[digit(100), digit(10), digit(1)]),
        _ => out.extend_from_slice(number.to_string().as_bytes()),
    }
}

/// The parameters of an SGR sequence, which is opened by the first one.
struct Sequence<'a> {
    out: &'a mut Vec<u8>,
    parameters: usize,
}

impl Sequence<'_> {
    fn push(&mut self, parameter: u16) {
        self.out
            .extend_from_slice(if self.parameters == 0 { b"\x1b[" } else { b";" });
        self.parameters += 1;
        push_number(self.out, parameter);
    }
}

/// Attributes with the codes that turn them on and off. Some share the code for off.
const ATTRIBUTES: [(Modifier, u16, u16); 9] = [
    (Modifier::BOLD, 1, 22),
    (Modifier::DIM, 2, 22),
    (Modifier::ITALIC, 3, 23),
    (Modifier::UNDERLINED, 4, 24),
    (Modifier::SLOW_BLINK, 5, 25),
    (Modifier::RAPID_BLINK, 6, 25),
    (Modifier::REVERSED, 7, 27),
    (Modifier::HIDDEN, 8, 28),
    (Modifier::CROSSED_OUT, 9, 29),
];

fn attributes(from: Modifier, to: Modifier, sequence: &mut Sequence) {
    if from == to {
        return;
    }
    let mut current = from;
    for (attribute, _, off) in ATTRIBUTES {
        if (current - to).contains(attribute) {
            sequence.push(off);
            for (other, _, same) in ATTRIBUTES {
                if same == off {
                    current -= other;
                }
            }
        }
    }
    for (attribute, on, _) in ATTRIBUTES {
        if (to - current).contains(attribute) {
            sequence.push(on);
        }
    }
}

/// Writes a colour; `base` is 30 for the foreground and 40 for the background.
fn ink_parameters(ink: Ink, base: u16, sequence: &mut Sequence) {
    match ink {
        Ink::Default => sequence.push(base + 9),
        Ink::Index(index @ 0..8) => sequence.push(base + u16::from(index)),
        Ink::Index(index @ 8..16) => sequence.push(base + 52 + u16::from(index)),
        Ink::Index(index) => {
            for parameter in [base + 8, 5, u16::from(index)] {
                sequence.push(parameter);
            }
        }
        Ink::Rgb(red, green, blue) => {
            for parameter in [base + 8, 2, red.into(), green.into(), blue.into()] {
                sequence.push(parameter);
            }
        }
    }
}

fn ink_length(ink: Ink) -> usize {
    let digits = |value: u8| match value {
        0..10 => 1,
        10..100 => 2,
        _ => 3,
    };
    match ink {
        // Bright backgrounds take a third digit; too little to distinguish foreground and
        // background.
        Ink::Default | Ink::Index(0..16) => 2,
        Ink::Index(index) => 5 + digits(index),
        Ink::Rgb(red, green, blue) => 7 + digits(red) + digits(green) + digits(blue),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: Style = Style {
        fg: Some(Ink::Default),
        bg: Some(Ink::Default),
        modifier: Modifier::empty(),
        indifferent: Modifier::empty(),
    };

    fn style(fg: Ink, bg: Ink, modifier: Modifier) -> Style {
        Style {
            fg: Some(fg),
            bg: Some(bg),
            modifier,
            ..PLAIN
        }
    }

    /// Applies styles in order to a fresh pen and returns the bytes of the last one.
    fn last_change(styles: &[Style]) -> String {
        let mut pen = Pen::UNKNOWN;
        let mut out = Vec::new();
        pen.reset(&mut out);
        for style in styles {
            out.clear();
            pen.apply(style, &mut out);
        }
        String::from_utf8(out).expect("sequences are ASCII")
    }

    #[test]
    fn sends_only_changes() {
        let (index, background) = (Ink::Index(1), Ink::Rgb(1, 20, 255));
        let red = style(index, Ink::Default, Modifier::empty());
        let rgb = style(index, background, Modifier::empty());
        let bold = style(index, background, Modifier::BOLD);
        let dim = style(index, background, Modifier::DIM);
        let both = style(index, background, Modifier::BOLD | Modifier::DIM);
        for (styles, bytes) in [
            (&[PLAIN][..], ""),
            (&[red], "\x1b[31m"),
            (&[red, red], ""),
            (&[red, rgb], "\x1b[48;2;1;20;255m"),
            (&[rgb, bold], "\x1b[1m"),
            (&[bold, dim], "\x1b[22;2m"),
            (&[both, dim], "\x1b[22;2m"),
            (&[bold, PLAIN], "\x1b[m"),
            (&[rgb, red], "\x1b[49m"),
            (&[PLAIN, rgb], "\x1b[31;48;2;1;20;255m"),
        ] {
            assert_eq!(last_change(styles), bytes, "{styles:?}");
        }
    }

    #[test]
    fn invisible_attributes_are_not_changed() {
        let bold = style(Ink::Index(9), Ink::Default, Modifier::BOLD);
        let line = style(Ink::Index(9), Ink::Default, Modifier::UNDERLINED);
        let blank = Style {
            fg: None,
            indifferent: Modifier::all() - VISIBLE_ON_BLANK,
            ..PLAIN
        };
        for (styles, bytes) in [
            (&[bold][..], "\x1b[1;91m"),
            (&[bold, blank], ""),
            (&[bold, blank, bold], ""),
            (&[line, blank], "\x1b[24m"),
        ] {
            assert_eq!(last_change(styles), bytes, "{styles:?}");
        }
    }

    #[test]
    fn the_cost_of_colours_is_their_length() {
        let rgb = Ink::Rgb(0, 50, 200);
        let inks = [Ink::Default, Ink::Index(3), Ink::Index(77), rgb];
        for (fg, bg) in inks.map(|fg| inks.map(|bg| (fg, bg))).concat() {
            let mut pen = Pen::UNKNOWN;
            let mut out = Vec::new();
            // Another attribute prevents a full reset of the pen.
            let start = style(Ink::Index(1), Ink::Default, Modifier::BOLD);
            pen.apply(&start, &mut out);
            out.clear();
            let style = style(fg, bg, Modifier::BOLD);
            let cost = pen.colour_cost(&style);
            pen.apply(&style, &mut out);
            assert_eq!(cost, out.len(), "{style:?}");
        }
    }
}
