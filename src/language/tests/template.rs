//! The scenes to begin with.

use super::{Language, read_as, shown};
use scene::Meshes;

#[test]
fn templates_are_small_valid_scenes() {
    for language in Language::ALL {
        let text = language.template();
        let (source, lowered) = read_as(language, text, &Meshes::default());
        assert_eq!(shown(text, &lowered), [""; 0], "{language:?}");
        let scene = lowered.scene.expect("it is valid");
        assert_eq!(scene.objects.len(), 2, "{language:?}");
        assert!(2 <= scene.lights.len(), "{language:?}");
        assert!(!source.fields(crate::Node::View).is_empty());
        assert!(text.ends_with('\n') && !text.contains('\t'), "{language:?}");
        assert!(text.lines().all(|line| line.len() <= 100), "{language:?}");
    }
}

#[test]
fn column_headings_do_not_describe_what_follows() {
    let text = Language::Dat.template();
    let (source, _) = read_as(Language::Dat, text, &Meshes::default());
    for node in source.nodes().iter() {
        let comment = source.comment(node).unwrap_or_default();
        assert!(!comment.contains("  "), "{node}: {comment}");
    }
}
