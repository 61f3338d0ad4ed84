//! What the file of a picture says of how it was made. Files come from anywhere: what cannot be used is
//! left out, and counted among what is wrong.

use super::provenance::Provenance;
use crate::job::{Aov, Region, SAMPLES, Settings, aov_name, aov_of, is_added, settings_text};
use scene::{MAX_PIXELS, RenderKey, Rendering, Scene, Size, Viewpoint};

/// How a picture was made, as far as its file says and can be believed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PictureMetadata {
    /// The version of the program that made it.
    pub version: Option<String>,
    /// The digest of the scene's text and all files it names.
    pub scene: Option<String>,
    /// What differed from the scene's own camera.
    pub view: Viewpoint,
    /// The AOVs beside the picture.
    pub layers: Vec<Aov>,
    /// Whether its noise was reduced.
    pub denoise: bool,
    /// The size of the whole picture.
    pub size: Option<Size>,
    /// The only part of it that was traced.
    pub region: Option<Region>,
    /// The random seed.
    pub seed: Option<u32>,
    /// The AOV that it shows instead of light.
    pub aov: Option<Aov>,
    /// The other settings, in the ranges that the command line permits.
    pub rendering: Rendering,
    /// The names of the entries that are there.
    there: Vec<&'static str>,
    /// The entries that were read.
    read: Vec<(&'static str, String)>,
    /// The first of what cannot be used.
    wrong: Vec<String>,
    /// How much more of it there is.
    more: usize,
}

/// How many unusable entries are named.
const NAMED: usize = 3;

/// More bytes than any value has: a view of numbers that are written without exponents.
const LONGEST_VALUE: usize = 8192;

/// The most characters named of an entry that cannot be used.
const LONGEST: usize = 40;

/// Sets a field from its entry's text; `None` if the text is invalid.
type Take = fn(&mut PictureMetadata, &str) -> Option<()>;

/// Sets an optional field; `None`, leaving it as it was, if the value is invalid.
fn set<T>(place: &mut Option<T>, value: Option<T>) -> Option<()> {
    *place = Some(value?);
    Some(())
}

/// The entries before those of the settings, with the names that [`Provenance::written`] gives them.
#[rustfmt::skip]
const PICTURE: &[(&str, Take)] = &[
    ("version", |to, value| set(&mut to.version, Some(value.to_owned()))),
    ("scene", |to, value| set(&mut to.scene, Some(value.to_owned()))),
    ("view", |to, value| {
        if value != "own" {
            to.view = Viewpoint::parse(value).ok()?;
        }
        Some(())
    }),
    ("layers", |to, value| {
        if value != "none" {
            to.layers = value.split(',').map(aov_of).collect::<Option<_>>()?;
        }
        Some(())
    }),
    (DENOISE, |to, value| {
        to.denoise = value == "yes";
        to.denoise.then_some(())
    }),
];

/// The entries of settings that are not render settings.
#[rustfmt::skip]
const FRAME: &[(&str, Take)] = &[
    ("size", |to, value| set(&mut to.size, Size::parse(value))),
    ("region", |to, value| match value {
        "none" => Some(()),
        _ => set(&mut to.region, Region::parse(value)),
    }),
    ("seed", |to, value| set(&mut to.seed, value.parse().ok())),
    ("aov", |to, value| match value {
        "none" => Some(()),
        _ => set(&mut to.aov, aov_of(value)),
    }),
];

/// The entry of pictures whose noise is reduced.
const DENOISE: &str = "denoise";

/// The names of all entries, in the order in which they are written.
fn names() -> impl Iterator<Item = &'static str> {
    let picture = PICTURE.iter().map(|(name, _)| *name);
    picture.chain(settings_text::names()).chain([SAMPLES])
}

/// Whether each picture has this entry; what others lack is off.
fn is_always(name: &str) -> bool {
    name != DENOISE && !RenderKey::named(name).is_some_and(is_added)
}

impl PictureMetadata {
    /// Reads metadata: an entry a line, its name before the first blank. Of an entry given twice the
    /// first good value counts.
    pub fn read(text: &str) -> Self {
        let mut metadata = Self::default();
        for line in text.lines().filter(|line| !line.is_empty()) {
            let (name, value) = line.split_once(' ').unwrap_or((line, ""));
            let known = names().find(|known| *known == name);
            if let Some(name) = known
                && !metadata.there.contains(&name)
            {
                metadata.there.push(name);
            }
            let is_new = |name: &&str| metadata.read.iter().all(|(read, _)| read != name);
            let new = known.filter(|name| is_new(name) && value.len() <= LONGEST_VALUE);
            match new.filter(|name| metadata.take(name, value).is_some()) {
                Some(name) => metadata.read.push((name, value.to_owned())),
                None => metadata.refuse(line),
            }
        }
        if !metadata.read.is_empty() {
            metadata.complete();
        }
        metadata
    }

    /// Takes the value of an entry; `None` if the entry is unknown or its value invalid.
    fn take(&mut self, name: &str, value: &str) -> Option<()> {
        let mut own = PICTURE.iter().chain(FRAME);
        if let Some((_, take)) = own.find(|(own, _)| *own == name) {
            return take(self, value);
        }
        let key = RenderKey::named(name)?;
        let value = key.setting().values.read(value)?;
        self.rendering = key.with(value, &self.rendering);
        Some(())
    }

    /// Names what is missing, and sets what is off if nothing says otherwise.
    fn complete(&mut self) {
        for name in names().filter(|name| is_always(name)) {
            if !self.there.contains(&name) {
                self.count(format!("{name} is missing"));
            }
        }
        for key in RenderKey::all().filter(|key| is_added(*key)) {
            let off = key.in_use(&Rendering::default());
            self.rendering = self.rendering.or(key.with(off, &Rendering::default()));
        }
    }

    /// The name and value of each entry that was read, in the order of the file. May contain control
    /// characters.
    pub fn entries(&self) -> &[(&'static str, String)] {
        &self.read
    }

    /// Whether nothing in it can be used.
    pub fn is_empty(&self) -> bool {
        self.read.is_empty()
    }

    /// Drops a size of more than so many pixels.
    pub fn limit(&mut self, most: u64) {
        let is_larger = |size: &mut Size| {
            let Size { width, height } = *size;
            most < u64::from(width) * u64::from(height)
        };
        if let Some(Size { width, height }) = self.size.take_if(is_larger) {
            self.refuse(&format!("size {width}x{height}"));
        }
    }

    /// Counts an entry as not used, such as `spp 0`.
    pub fn refuse(&mut self, what: &str) {
        let mut shortened: String = what.chars().take(LONGEST).collect();
        if shortened.len() < what.len() {
            shortened.push('…');
        }
        self.count(shortened);
    }

    /// Counts something as wrong.
    fn count(&mut self, what: String) {
        if self.wrong.len() < NAMED {
            self.wrong.push(what);
        } else {
            self.more += 1;
        }
    }

    /// What of it is not used, if anything: `new 1, spp 0 and 2 more`. May contain control characters.
    pub fn unused(&self) -> Option<String> {
        let more = match self.more {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let named = self.wrong.join(", ");
        (!self.wrong.is_empty()).then(|| named + &more)
    }

    /// All of it; `None` if anything is missing or wrong, or if more than [`MAX_PIXELS`] were traced.
    pub fn provenance(&self) -> Option<Provenance> {
        let size = self.size.filter(|_| self.wrong.is_empty())?;
        let region = self.region.map(|region| region.within(size));
        let settings = Settings {
            region: region.transpose().ok()?,
            seed: self.seed?,
            aov: self.aov,
            ..Settings::new(size, &self.rendering)
        };
        if MAX_PIXELS < settings.traced().size().pixels() as u64 {
            return None;
        }
        Some(Provenance {
            version: self.version.clone()?,
            scene: self.scene.clone()?,
            view: self.view.clone(),
            layers: self.layers.clone(),
            denoise: self.denoise,
            settings,
        })
    }

    /// The size of the whole picture and what of it was traced, for a file whose picture has this size.
    /// If the metadata says something else, the picture is taken to be whole.
    pub fn framing(&mut self, picture: Size) -> (Size, Option<Region>) {
        let Some(size) = self.size else {
            return (picture, None);
        };
        let is_within = |region: Region| region.within(size).is_ok();
        let traced = self.region.map_or(size, Region::size);
        if traced == picture && self.region.is_none_or(is_within) {
            return (size, self.region);
        }
        let Size { width, height } = size;
        let region = self.region.take();
        let region = region.map_or_else(String::new, |region| format!(" region {region}"));
        self.size = None;
        let is = format!("{}x{}", picture.width, picture.height);
        self.count(format!(
            "size {width}x{height}{region} (the picture is {is})"
        ));
        (picture, None)
    }

    /// Drops what a scene with this camera cannot show: a view that is none, and the light of a lamp
    /// that is not there.
    pub fn fit(&mut self, scene: &Scene) {
        if self.view.of(&scene.camera).is_err() {
            let view = std::mem::take(&mut self.view);
            self.refuse(&format!("view {view}"));
        }
        if let Some(aov @ Aov::Direct(light)) = self.aov
            && scene.lights.len() <= light as usize
        {
            self.aov = None;
            self.refuse(&format!("aov {}", aov_name(aov)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::AOVS;
    use scene::Transfer;

    const WHOLE: &str = "version 1\nscene 0\nview own\nlayers none\nsize 8x6\nregion none\ndepth 2\n\
                         seed 7\naov none\nintegrator path\nfilter box\ntransfer srgb\nexposure -1\n\
                         falloff none\ngloss none\nspp 4\n";

    const SIZE: Size = Size {
        width: 8,
        height: 6,
    };

    #[test]
    fn what_can_be_used_is_used_and_the_rest_is_named() {
        for (from, to, unused) in [
            ("", "", None),
            ("depth 2\n", "", Some("depth is missing")),
            (
                "falloff none\ngloss none\nspp 4\n",
                "",
                Some("falloff is missing, gloss is missing, spp is missing"),
            ),
            ("depth 2", "depth 4097", Some("depth 4097")),
            ("spp 4", "spp 0", Some("spp 0")),
            ("exposure -1", "exposure inf", Some("exposure inf")),
            ("spp 4", "noise 1\nspp 4", Some("noise 1")),
            ("spp 4", "clamp nan\nspp 4", Some("clamp nan")),
            ("view own", "view eye 1", Some("view eye 1")),
            ("gloss none", "depth 3\ngloss none", Some("depth 3")),
            ("version 1", "a\nb\nc\nd\ne", Some("a, b, c and 3 more")),
            ("seed 7\n", "seed 7\n\n", None),
        ] {
            let text = WHOLE.replacen(from, to, 1);
            let metadata = PictureMetadata::read(&text);
            assert_eq!(metadata.unused().as_deref(), unused, "{text}");
            assert_eq!(metadata.rendering.transfer, Some(Transfer::Srgb), "{text}");
            assert_eq!(metadata.provenance().is_some(), unused.is_none(), "{text}");
        }
        let depth = |text: &str| PictureMetadata::read(text).rendering.depth;
        assert_eq!(depth(&WHOLE.replace("gloss", "depth 3\ngloss")), Some(2));
    }

    #[test]
    fn a_record_cut_short_anywhere_is_read_as_far_as_it_goes() {
        for end in 0..WHOLE.len() {
            let metadata = PictureMetadata::read(&WHOLE[..end]);
            assert!(
                metadata.is_empty() || metadata.provenance().is_none() || WHOLE.len() - 1 <= end
            );
        }
        let huge = "x".repeat(1 << 20);
        let named = PictureMetadata::read(&huge)
            .unused()
            .expect("it is no entry");
        assert!(named.chars().count() <= LONGEST + 1, "{named}");
        assert!(PictureMetadata::read(&huge).is_empty());
    }

    #[test]
    fn whatever_is_written_is_read_again() {
        let metadata = PictureMetadata::read(WHOLE);
        let provenance = metadata.provenance().expect("nothing is wrong");
        let settings = provenance.settings;
        let written = format!("{}spp {}\n", provenance.lines(), settings.spp);
        assert_eq!(written, WHOLE);
        let other = WHOLE
            .replace("layers none", "layers depth,normal\ndenoise yes")
            .replace("view own", "view eye 1 2 3 fov 30")
            .replace("region none", "region 1,2,3,4")
            .replace("aov none", "aov direct 3")
            .replace("gloss", "noise 0.02\nclamp 8.5\ngloss");
        let metadata = PictureMetadata::read(&other);
        assert_eq!(metadata.unused(), None);
        let provenance = metadata.provenance().expect("nothing is wrong");
        assert_eq!(format!("{}spp 4\n", provenance.lines()), other);
    }

    #[test]
    fn settings_read_back_as_they_were() {
        let plain = Settings::new(SIZE, &Rendering::default());
        let all = RenderKey::all().fold(Rendering::default(), |all, key| {
            let values = key.setting().values.samples();
            values.last().map_or(all, |value| key.with(*value, &all))
        });
        let other = Settings {
            region: Some(Region {
                x: 1,
                y: 2,
                width: 3,
                height: 4,
            }),
            seed: u32::MAX,
            ..Settings::new(SIZE, &all)
        };
        let one = RenderKey::all().flat_map(|key| {
            let values = key.setting().values.samples().into_iter();
            let asked = values.map(move |value| key.with(value, &Rendering::default()));
            asked.map(|asked| Settings::new(SIZE, &asked))
        });
        let with = |&aov: &Aov| Settings {
            aov: Some(aov),
            ..other
        };
        let aovs = AOVS.iter().chain(&[Aov::Direct(3)]).map(with);
        for settings in [plain, other].into_iter().chain(one).chain(aovs) {
            let provenance = Provenance {
                settings,
                ..PictureMetadata::read(WHOLE)
                    .provenance()
                    .expect("nothing is wrong")
            };
            let text = format!("{}spp {}\n", provenance.lines(), settings.spp);
            assert_eq!(
                PictureMetadata::read(&text).provenance(),
                Some(provenance),
                "{text}"
            );
            // Each name and value is needed.
            for (name, value) in settings.written() {
                let entry = format!("\n{name} {value}\n");
                let wrong = text.replace(&entry, &format!("\n{name} ?\n"));
                assert_ne!(wrong, text);
                assert_eq!(PictureMetadata::read(&wrong).provenance(), None, "{name}");
            }
        }
    }

    #[test]
    fn a_size_that_is_not_the_picture_s_is_not_used() {
        let part = Region {
            x: 1,
            y: 2,
            width: 3,
            height: 4,
        };
        for (region, picture, expected, unused) in [
            ("none", SIZE, (SIZE, None), None),
            ("1,2,3,4", part.size(), (SIZE, Some(part)), None),
            (
                "none",
                part.size(),
                (part.size(), None),
                Some("size 8x6 (the picture is 3x4)"),
            ),
            (
                "1,2,3,4",
                SIZE,
                (SIZE, None),
                Some("size 8x6 region 1,2,3,4 (the picture is 8x6)"),
            ),
            (
                "7,2,3,4",
                part.size(),
                (part.size(), None),
                Some("size 8x6 region 7,2,3,4 (the picture is 3x4)"),
            ),
        ] {
            let mut metadata =
                PictureMetadata::read(&WHOLE.replace("region none", &format!("region {region}")));
            assert_eq!(metadata.framing(picture), expected);
            assert_eq!(metadata.unused().as_deref(), unused);
        }
    }
}
