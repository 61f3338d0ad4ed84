//! Render settings by name: what is declared of them, and their values as words and numbers.

use super::{ROWS, Rendering, Row};

/// What is declared of a render setting.
#[derive(Clone, Copy, Debug)]
pub struct RenderSetting {
    /// The values that it may have.
    pub values: Values,
    /// A description in one sentence.
    pub doc: &'static str,
    /// The increment of one nudge of a number.
    pub step: f64,
    /// The unit, or an empty string.
    pub unit: &'static str,
    /// Whether the text of a scene may state it.
    pub is_of_text: bool,
    /// The option that all commands which trace have in common.
    pub option: Option<CommandOption>,
    /// A description in configurations, if they may set it.
    pub config: Option<&'static str>,
    /// What help adds after the default where another may apply.
    pub else_default: &'static str,
}

impl RenderSetting {
    /// A setting that only texts state.
    pub(super) const fn new(values: Values, doc: &'static str) -> Self {
        Self {
            values,
            doc,
            step: 1.0,
            unit: "",
            is_of_text: true,
            option: None,
            config: None,
            else_default: "",
        }
    }
}

/// An option of the command line, which has the name of its setting.
#[derive(Clone, Copy, Debug)]
pub struct CommandOption {
    /// What stands for its value in help.
    pub value_name: &'static str,
    /// A description, without the default.
    pub help: &'static str,
}

impl CommandOption {
    pub(super) const fn new(value_name: &'static str, help: &'static str) -> Self {
        Self { value_name, help }
    }
}

/// The values that a setting may have; a number stands for each.
#[derive(Clone, Copy, Debug)]
pub enum Values {
    /// One of these words, by index.
    Words {
        /// The words.
        names: &'static [&'static str],
        /// What each means, as a phrase.
        meanings: &'static [&'static str],
    },
    /// An integer between two, inclusive.
    Whole(u32, u32),
    /// A number between two, inclusive.
    Within(f64, f64),
    /// From 0, inclusive, to a number, exclusive.
    Below(f64),
    /// 0 or more.
    NotNegative,
}

impl Values {
    /// Reads a value as [`Values::spelled`] writes it, or a number in any form that Rust parses; `None`
    /// if it is none of these values.
    pub fn read(self, word: &str) -> Option<f64> {
        let number = || word.parse().ok().filter(|number: &f64| number.is_finite());
        match self {
            Self::Words { names, .. } => {
                let place = names.iter().position(|name| *name == word);
                place.map(|place| place as f64)
            }
            Self::Whole(least, most) => {
                let number = word.parse().ok();
                number
                    .filter(|number| (least..=most).contains(number))
                    .map(f64::from)
            }
            Self::Within(least, most) => number().filter(|it| (least..=most).contains(it)),
            Self::Below(limit) => number().filter(|it| (0.0..limit).contains(it)),
            Self::NotNegative => number().filter(|it| 0.0 <= *it),
        }
    }

    /// The word for one of these values, or the shortest number that reads back as the same.
    pub fn spelled(self, value: f64) -> String {
        match self {
            Self::Words { names, .. } => names[value as usize].to_owned(),
            // Adding 0 keeps the number but turns −0 into 0.
            _ => (value + 0.0).to_string(),
        }
    }

    /// Some of these values, the ends and all words among them.
    pub fn samples(self) -> Vec<f64> {
        match self {
            Self::Words { names, .. } => (0..names.len()).map(|at| at as f64).collect(),
            Self::Whole(least, most) => vec![least.into(), most.into()],
            Self::Within(least, most) => vec![least, -0.1, most],
            Self::Below(limit) => vec![0.0, 0.02, limit.next_down()],
            Self::NotNegative => vec![0.0, 8.5, f64::MAX],
        }
    }

    /// These values as a noun phrase: `a number from -100 to 100`.
    pub fn expected(self) -> String {
        match self {
            Self::Words { names, .. } => names.join(" or "),
            Self::Whole(least, most) => format!("a whole number from {least} to {most}"),
            Self::Within(least, most) => format!("a number from {least} to {most}"),
            Self::Below(limit) => format!("a number of at least 0 and less than {limit}"),
            Self::NotNegative => "a number, 0 or more".to_owned(),
        }
    }
}

/// The key of a render setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RenderKey(usize);

impl RenderKey {
    /// The number of keys.
    pub const COUNT: usize = ROWS.len();

    /// All keys, in the order of the table.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..Self::COUNT).map(Self)
    }

    /// The keys that a text may state, in the order of the interface.
    pub fn of_text() -> impl Iterator<Item = Self> {
        Self::all().filter(|key| key.setting().is_of_text)
    }

    /// All keys, in the order of help and configurations: the counts most often given come first.
    pub fn listed() -> impl Iterator<Item = Self> {
        let first = ["spp", "depth"];
        let others = Self::all().filter(move |key| !first.contains(&key.name()));
        first.into_iter().filter_map(Self::named).chain(others)
    }

    /// The key with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|key| key.name() == name)
    }

    /// The name, such as `depth`.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// What is declared of it.
    pub fn setting(self) -> &'static RenderSetting {
        &self.row().setting
    }

    /// The keys of what is asked for, each with its value as [`Values::spelled`].
    pub fn stated(asked: &Rendering) -> impl Iterator<Item = (Self, String)> {
        let stated = |key: Self| {
            let value = key.get(asked)?;
            Some((key, key.setting().values.spelled(value)))
        };
        Self::all().filter_map(stated)
    }

    /// The value that is asked for, as a number; `None` if none is.
    pub fn get(self, asked: &Rendering) -> Option<f64> {
        (self.row().get)(asked)
    }

    /// The value that is asked for, or else the default, as [`Values::spelled`].
    pub fn value(self, asked: &Rendering) -> String {
        self.setting().values.spelled(self.in_use(asked))
    }

    /// As [`RenderKey::value`], as a number.
    pub fn in_use(self, asked: &Rendering) -> f64 {
        (self.row().in_use)(asked)
    }

    /// These settings with this one set to one of its [`Values`].
    #[must_use]
    pub fn with(self, value: f64, asked: &Rendering) -> Rendering {
        let mut asked = *asked;
        (self.row().set)(&mut asked, Some(value));
        asked
    }

    /// This one of these settings alone.
    #[must_use]
    pub fn alone(self, asked: &Rendering) -> Rendering {
        let mut alone = Rendering::default();
        (self.row().set)(&mut alone, self.get(asked));
        alone
    }

    /// These settings without this one.
    #[must_use]
    pub fn cleared(self, asked: &Rendering) -> Rendering {
        let mut asked = *asked;
        (self.row().set)(&mut asked, None);
        asked
    }

    fn row(self) -> &'static Row {
        &ROWS[self.0]
    }
}
