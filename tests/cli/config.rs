//! The configuration: its errors as printed, where it is found, and what it changes.

use super::*;

/// The lines printed for each faulty configuration, after the name of the file.
const FAULTS: &[(&str, &str)] = &[
    ("spp = \n", "1:7: x"),
    ("# sizes\nssp = 16\n", "2:1: unknown setting `ssp`"),
    ("spp = \"many\"\n", "1:7: `spp`: this is a string"),
    ("spp = 0\n", "1:7"),
    ("theme = \"drak\"\n", "1:9"),
    ("mouse = 1\n", "1"),
    ("editor = \" \"\n", "1"),
    ("assets = [\"/a\", \"b\"]\n", "1"),
    ("keys = 3\n", "1"),
    ("[keys]\nx = \"save\"\n", "1"),
    ("[keys.selct]\nx = \"save\"\n", "1"),
    ("[keys.select]\nEntr = \"edit\"\n", "1"),
    ("[keys.select]\ngg = \"first\"\n", "1"),
    ("[keys.select]\n\"Ctrl-I\" = \"edit\"\n", "1"),
    ("[keys.anywhere]\n\"Ctrl-C\" = \"save\"\n", "1"),
    ("[keys.edit]\n1 = \"save\"\n", "1"),
    ("[keys.anywhere]\n- = \"save\"\n", "1"),
    ("[keys.move]\n\".\" = \"snap\"\n", "1"),
    ("[keys.select]\nx = 1\n", "1"),
    ("[keys.select]\nx = \"duplicat\"\n", "1"),
    ("[keys.select]\nx = \"frobnicate\"\n", "1"),
    ("[keys.view]\nx = \"delete\"\n", "1"),
    (
        "[keys.anywhere]\n\"ctrl-s\" = \"save\"\n\"Ctrl-S\" = \"undo\"\n",
        "1",
    ),
    (
        "[keys.select]\nd = \"delete\"\n\"d d\" = \"duplicate\"\n",
        "1",
    ),
    ("[keys.select]\nF1 = \"duplicate\"\nD = \"none\"\n", "1"),
    ("spp = 1\nspp = 2\n", "1"),
];

#[test]
fn each_error_is_printed_with_its_place_and_advice() {
    let place = Place::new();
    for (text, expected) in FAULTS {
        place.write("a.toml", text);
        let printed = place.stderr("--config a.toml --print-config", 2);
        assert_eq!(printed.trim_end(), *expected, "{text}");
    }
}
