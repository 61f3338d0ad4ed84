//! The arguments that take precedence over the render settings of a scene's text: one for each
//! setting that has an option.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, ValueParser};
use clap::error::Error;
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};

use scene::{CommandOption, RenderKey, RenderSetting, Rendering, Values};

/// The settings asked for.
#[derive(Debug)]
pub(super) struct RenderingArguments(Rendering);

impl RenderingArguments {
    /// The settings asked for, with this number of samples.
    pub(super) fn rendering(&self, spp: Option<u32>) -> Rendering {
        Rendering { spp, ..self.0 }
    }
}

impl Args for RenderingArguments {
    fn augment_args(command: Command) -> Command {
        command.args(RenderKey::listed().filter_map(argument))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for RenderingArguments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let given = RenderKey::all().filter(|key| key.setting().option.is_some());
        Ok(Self(given.fold(Rendering::default(), |asked, key| {
            let value = matches.get_one::<f64>(key.name());
            value.map_or(asked, |value| key.with(*value, &asked))
        })))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        self.0 = Self::from_arg_matches(matches)?.0.or(self.0);
        Ok(())
    }
}

/// The option of a setting, if it has one.
fn argument(key: RenderKey) -> Option<Arg> {
    let RenderSetting {
        option,
        values,
        is_of_text,
        else_default,
        ..
    } = *key.setting();
    let CommandOption { value_name, help } = option?;
    let otherwise = if is_of_text {
        "the scene's, otherwise "
    } else {
        ""
    };
    let default = key.value(&Rendering::default());
    let argument = Arg::new(key.name())
        .long(key.name())
        .value_name(value_name)
        .allow_negative_numbers(!matches!(values, Values::Words { .. }))
        .value_parser(parser(values))
        .help(format!(
            "{help} [default: {otherwise}{default}{else_default}]"
        ));
    Some(argument)
}

/// Parses a value as the number that stands for it.
fn parser(values: Values) -> ValueParser {
    if let Values::Words { names, meanings } = values {
        let words = names.iter().zip(meanings);
        let words = words.map(|(name, meaning)| PossibleValue::new(*name).help(*meaning));
        let words = PossibleValuesParser::new(words);
        return ValueParser::new(words.try_map(move |word| values.read(&word).ok_or("unknown")));
    }
    let read = move |text: &str| {
        let number = values.read(text);
        number.ok_or_else(|| format!("expected {}", values.expected()))
    };
    ValueParser::new(read)
}
