//! Lowering never panics on any text, and never reports places outside it.

use std::sync::Arc;

use proptest::prelude::*;

use super::edits::RICH;
use super::{EXAMPLE, around, read_with};
use geometry::Shape;
use scene::{Highlight, Meshes, NoMesh, Pattern};
use text::Span;

/// One readable mesh and one unreadable.
fn meshes() -> Meshes {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib a.mtl\nf 1 2 3\nusemtl a\nf 1 3 2\nwhat\n";
    let library = "newmtl a\nKd 1 0 0\nmap_Ks b.png\n";
    let sound = obj::read(text.as_bytes(), |_| Ok::<_, String>(library)).map(Arc::new);
    let fault = NoMesh::Unread {
        reason: "no such file".to_owned(),
        hint: None,
    };
    let sound = sound.map_err(|_| fault.clone());
    let meshes = [("a.obj", sound), ("b.obj", Err(fault))];
    let named = meshes.map(|(name, read)| (name.to_owned(), read));
    named.into_iter().collect()
}

fn check(text: &str) {
    let (source, lowered) = read_with(text, &meshes());
    let within = |span: Span| span.end() <= text.len() && text.get(span.range()).is_some();
    assert!(
        lowered.diagnostics.iter().all(|found| within(found.span)),
        "{text:?}"
    );
    assert!(
        lowered
            .diagnostics
            .is_sorted_by_key(|found| found.span.start())
    );
    let has_errors = 0 < lowered.diagnostics.errors();
    assert_eq!(lowered.scene.is_none(), has_errors, "{text:?}");
    let nodes = source.nodes();
    assert!(nodes.iter().is_sorted());
    for node in nodes.iter() {
        assert!(!source.name(node).is_empty());
        assert!(within(source.span(node)), "{text:?}");
        let _ = source.comment(node);
        for placed in source.fields(node) {
            assert_eq!(
                placed.spans.len(),
                placed.field.kind.components(),
                "{text:?}"
            );
            for (component, &span) in placed.spans.iter().enumerate() {
                assert!(within(span), "{text:?}");
                if placed.default_of(component).is_none() {
                    assert_eq!(source.node_at(span), Some(node), "{text:?}");
                }
                let put = placed.edits(&*source, &[(component, "1".to_owned())]);
                assert!(put.len() == 1 && within(put[0].span), "{text:?}");
            }
        }
    }
    for file in source.files() {
        assert!(within(file.span));
    }
    let Some(scene) = lowered.scene else { return };
    for (index, object) in scene.objects.iter().enumerate() {
        assert!((object.material as usize) < scene.materials.len());
        if let Shape::Mesh(instance) = &object.shape {
            let tags = instance.tags().flatten();
            assert!(
                tags.into_iter()
                    .all(|tag| (tag as usize) < scene.materials.len())
            );
        }
        let listed = source.object(index as u32);
        assert_eq!(source.drawn(listed), Some(index as u32));
    }
    let textures = scene.textures.len() as u32;
    for (index, texture) in (0..).zip(&scene.textures) {
        assert!(texture.inverse.is_finite(), "{text:?}");
        if let Pattern::Checker { squares, .. } = &texture.pattern {
            let inner = squares.iter().filter_map(|square| square.texture);
            assert!(inner.into_iter().all(|at| index < at && at < textures));
        }
    }
    for material in scene.materials.iter() {
        assert!(!matches!(material.highlight, Highlight::Phong(_)));
        assert!(material.colour().is_finite());
    }
}

/// Valid and invalid fragments of scenes.
fn pieces() -> impl Strategy<Value = String> {
    let piece = prop::sample::select(vec![
        "<object>",
        "<object type='sphere' material='m'>",
        "</object>",
        "<object type='plane'/>",
        "<object type='obj' name='a.obj'>",
        "<object type='obj' name='a.obj' material='m'/>",
        "<object type='obj' name='b.obj'/>",
        "<object type='obj' name='c.obj'/>",
        "<object type='obj'/>",
        "<scale value='2'/>",
        "<scale x='0'/>",
        "<rotate x='1' angle='45'/>",
        "<translate z='1e308'/>",
        "<material name='m'>",
        "</material>",
        "<diffuse texture='checkerboard'>",
        "</diffuse>",
        "<color1 texture='a.png'/>",
        "<color2 texture='checkerboard'>",
        "</color2>",
        "<light type='point'>",
        "<light type='direct'/>",
        "</light>",
        "<intensity value='.5'/>",
        "<position x='1,5'/>",
        "<background texture='b.png'/>",
        "<scene>",
        "</scene>",
        "<camera gamma='sRGB'>",
        "</camera>",
        "<fov value='0'/>",
        "<width value='2'/>",
        "word",
        "<!-- said -->",
        "\r\n  ",
        "é",
        "&amp;",
        "<",
        " x='1'",
        "\"",
        "value='",
        "/>",
    ]);
    prop::collection::vec(piece, 0..16).prop_map(|pieces| pieces.concat())
}

proptest! {
    #![proptest_config(repeatable::config())]

    #[test]
    fn any_text_is_read(inside in pieces(), outside in pieces()) {
        check(&inside);
        check(&around(&inside));
        check(&format!("<xml>{outside}</xml>"));
    }

    #[test]
    fn mutated_scenes_are_read(rich in any::<bool>(), at in any::<prop::sample::Index>(), len in 0..60usize, put in pieces()) {
        let mut text = if rich { RICH } else { EXAMPLE }.to_owned();
        let start = at.index(text.len());
        let end = (start + len).min(text.len());
        text.replace_range(start..end, &put);
        check(&text);
    }
}
