//! What texts mean beside their pixels.

use super::read;
use crate::{Node, outlook};
use scene::{Integrator, Rendering};

const HEAD: &str = "camera 0 0 9 0 0 0 0 1 0 45\nsize 8 6\n";

/// The depth of a text by an integrator.
fn depth(own: &str, integrator: Integrator) -> u32 {
    let (_, lowered) = read(&format!("{HEAD}{own}sphere 0 0 0 1\n"));
    let scene = lowered.scene.expect("it has no errors");
    let asked = Rendering {
        integrator: Some(integrator),
        ..scene.setting.rendering
    };
    asked.depth()
}

#[test]
fn depths_are_those_of_the_integrator() {
    for (own, whitted, path) in [
        ("", 5, 64),
        ("maxdepth 7\n", 7, 7),
        ("maxdepth -1\n", 64, 64),
        ("integrator direct\n", 5, 1),
        ("integrator analyticdirect\nmaxdepth 7\n", 7, 1),
        ("integrator direct\nintegrator pathtracer\n", 5, 64),
        ("# render: depth 3\nintegrator direct\nmaxdepth 7\n", 3, 3),
    ] {
        assert_eq!(depth(own, Integrator::Whitted), whitted, "{own}");
        assert_eq!(depth(own, Integrator::Path), path, "{own}");
    }
}

#[test]
fn materials_are_those_that_state_lines_make() {
    let lamp = "quadLight 0 0 5 1 0 0 0 1 0 1 1 1\n";
    let own = format!("{HEAD}{lamp}sphere 0 0 0 1\n{lamp}diffuse 1 0 0\nsphere 2 0 0 1\n");
    let (source, lowered) = read(&own);
    assert_eq!(
        source
            .nodes()
            .iter()
            .filter(|node| matches!(node, Node::Material(_)))
            .count(),
        2
    );
    let scene = lowered.scene.expect("it has no errors");
    let used: Vec<_> = scene.objects.iter().map(|object| object.material).collect();
    assert_eq!(used, [2, 0, 3, 1]);
    assert_eq!(source.material(0), None);
    assert_eq!(source.material(3), Some(1));
    let at = own.find("diffuse").expect("it is there");
    assert_eq!(source.node_at(text::Span::at(at)), Some(Node::Material(1)));
}

#[test]
fn an_area_light_alone_is_told_by_whitted_rays() {
    let text = format!("{HEAD}ambient 0 0 0\nsphere 0 0 0 1\nquadLight 0 0 5 1 0 0 0 1 0 1 1 1\n");
    let (source, lowered) = read(&text);
    let scene = lowered.scene.expect("it has no errors");
    let asked = |integrator| Rendering {
        integrator: Some(integrator),
        ..scene.setting.rendering
    };
    let said = |integrator| {
        let found = outlook(&source, &scene, &scene.camera, &asked(integrator));
        let said = found.into_iter().map(|found| found.warning.message);
        said.filter(|said| said.contains("the only light is emission"))
            .count()
    };
    assert_eq!([Integrator::Whitted, Integrator::Path].map(said), [1, 0]);
}
