//! Reading meshes and their libraries.

use super::*;
use obj::Model;
use scene::NoMesh;

/// A triangle with a library in the same folder.
const TRIANGLE: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";

impl Place {
    fn wanted_meshes(&self, names: &[&str]) -> Wanted {
        Wanted {
            meshes: names.iter().map(|name| (*name).to_owned()).collect(),
            ..self.wanted(&[])
        }
    }
}

fn model(loaded: &Loaded, name: &str) -> Arc<Model> {
    match loaded.meshes.get(name) {
        Some(Ok(model)) => Arc::clone(model),
        other => panic!("{name}: {other:?}"),
    }
}

fn warnings(loaded: &Loaded, name: &str) -> Vec<String> {
    let model = model(loaded, name);
    let warnings = model.warnings.iter().chain(&model.library_warnings);
    warnings.map(ToString::to_string).collect()
}

#[test]
fn meshes_are_read_with_their_libraries() {
    let place = Place::new();
    fs::create_dir_all(place.at("meshes/skins")).expect("a folder");
    let mesh = TRIANGLE.replace("a.mtl", "skins/a.mtl");
    place.write("meshes/a.obj", mesh);
    place.write("meshes/skins/a.mtl", "newmtl a\nKd 0 1 0\n");
    let name = "meshes/a.obj";
    let wanted = place.wanted_meshes(&[name]);
    let mut assets = Assets::new(&[]);
    assert_eq!(assets.places(&wanted), [place.at(name)]);
    let loaded = assets.read(&wanted);
    assert_eq!(warnings(&loaded, name), [""; 0]);
    let model = model(&loaded, name);
    let colours: Vec<_> = model
        .materials
        .iter()
        .flatten()
        .map(|m| m.diffuse)
        .collect();
    assert_eq!(colours, [[0.0, 1.0, 0.0]]);
    // The library is known now and watched too.
    let library = place.at("meshes/skins/a.mtl");
    assert_eq!(assets.places(&wanted), [place.at(name), library]);
}

#[test]
fn a_mesh_that_cannot_be_read_is_reported_with_the_reason() {
    let place = Place::new();
    let elsewhere = tempfile::tempdir().expect("a directory");
    let folder = fs::canonicalize(elsewhere.path()).expect("a place");
    let outside = folder.join("a.obj");
    fs::write(&outside, TRIANGLE).expect("written");
    symlink(&outside, place.at("link.obj")).expect("a link");
    fs::create_dir(place.at("folder.obj")).expect("a folder");
    place.write(
        "bad.obj",
        "v 0 0 0\nv 1 0 x\nv 0 1 0\nf 1 2\nf 1 3 2\nf 1 3 3 4\n",
    );
    place.write("empty.obj", "");
    let long = fs::File::create(place.at("long.obj")).expect("made");
    long.set_len(LIMITS.bytes + 1).expect("a hole");
    let looked_for = format!("looked for {}", place.at("none.obj").display());
    let allow = format!("allow it with --assets {}", folder.display());
    let absolute = outside.to_str().expect("a plain path");
    let outside = format!("is outside {}", place.root().display());
    let refused = |name: &str| match Assets::new(&[])
        .read(&place.wanted_meshes(&[name]))
        .meshes
        .get(name)
    {
        Some(Err(NoMesh::Unread { reason, hint })) => (vec![reason.clone()], hint.clone()),
        Some(Err(NoMesh::Malformed(findings))) => {
            (findings.iter().map(ToString::to_string).collect(), None)
        }
        other => panic!("{name}: {other:?}"),
    };
    for (name, reasons, hint) in [
        ("none.obj", &["no such file"][..], Some(looked_for)),
        ("folder.obj", &["is a folder, not a file"], None),
        (
            absolute,
            &["absolute paths are not allowed"],
            Some(allow.clone()),
        ),
        ("link.obj", &[outside.as_str()], Some(allow)),
        (
            "bad.obj",
            &[
                "line 2, column 7: v: `x` is not a number",
                "line 6, column 9: f: refers to v 4, but there are only 3",
                "line 6, column 10: the file has no faces that can be used",
            ],
            None,
        ),
        (
            "empty.obj",
            &["line 1, column 1: the file has no faces that can be used"],
            None,
        ),
        (
            "long.obj",
            &["the scene's files have more than 512 MiB in total"],
            None,
        ),
    ] {
        let reasons: Vec<_> = reasons.iter().map(|&reason| reason.to_owned()).collect();
        assert_eq!(refused(name), (reasons, hint), "{name}");
    }
    let loaded = Assets::new(&[folder]).read(&place.wanted_meshes(&[absolute]));
    assert_eq!(model(&loaded, absolute).mesh.len(), 1);
}

#[test]
fn a_library_that_cannot_be_read_is_a_warning() {
    let place = Place::new();
    let elsewhere = tempfile::tempdir().expect("a directory");
    let folder = fs::canonicalize(elsewhere.path()).expect("a place");
    fs::write(folder.join("a.mtl"), "newmtl a\n").expect("written");
    let absolute = folder.join("a.mtl").display().to_string();
    place.write("bad.mtl", "newmtl a\nKd x\n");
    let white = obj::read(TRIANGLE.as_bytes(), |_| Ok::<_, String>("newmtl a"));
    let white = white.expect("a valid mesh").materials.remove(1);
    let defined = white.map(|white| obj::Material {
        library: "bad.mtl".into(),
        ..white
    });
    for (library, warning, material) in [
        (
            "none.mtl",
            "line 1, column 8: cannot read `none.mtl`: no such file".to_owned(),
            None,
        ),
        (
            absolute.as_str(),
            format!(
                "line 1, column 8: cannot read `{absolute}`: absolute paths are not allowed \
                 (allow it with --assets {})",
                folder.display()
            ),
            None,
        ),
        (
            "bad.mtl",
            "bad.mtl: line 2, column 4: Kd: `x` is not a number".to_owned(),
            defined,
        ),
    ] {
        place.write("a.obj", TRIANGLE.replace("a.mtl", library));
        let loaded = Assets::new(&[]).read(&place.wanted_meshes(&["a.obj"]));
        assert_eq!(warnings(&loaded, "a.obj"), [warning]);
        assert_eq!(model(&loaded, "a.obj").materials, [None, material]);
    }
}

#[test]
fn known_meshes_are_not_parsed_again() {
    let place = Place::new();
    place.write("a.obj", TRIANGLE);
    place.write("b.obj", TRIANGLE);
    place.write("a.mtl", "newmtl a\nKd 0 1 0\n");
    let wanted = place.wanted_meshes(&["a.obj", "b.obj"]);
    let mut assets = Assets::new(&[]);
    let first = assets.read(&wanted);
    assert!(Arc::ptr_eq(
        &model(&first, "a.obj"),
        &model(&first, "b.obj")
    ));
    let again = assets.read(&wanted);
    assert_eq!(first.meshes, again.meshes);

    // Different materials, the same triangles.
    place.write("a.mtl", "newmtl a\nKd 0 0 1\n");
    let second = assets.read(&wanted);
    assert_ne!(first.meshes, second.meshes);
    let (old, new) = (model(&first, "a.obj"), model(&second, "a.obj"));
    assert!(Arc::ptr_eq(&old.mesh, &new.mesh));
    let blue = new.materials[1].as_ref().map(|material| material.diffuse);
    assert_eq!(blue, Some([0.0, 0.0, 1.0]));
    fs::remove_file(place.at("a.mtl")).expect("it is there");
    assert_eq!(warnings(&assets.read(&wanted), "a.obj").len(), 1);
    place.write("a.mtl", "newmtl a\nKd 0 0 1\n");
    assert_eq!(warnings(&assets.read(&wanted), "a.obj"), [""; 0]);

    place.write("a.obj", TRIANGLE.replace("1 2 3", "1 3 2"));
    let third = assets.read(&wanted);
    assert!(!Arc::ptr_eq(&model(&third, "a.obj").mesh, &new.mesh));
    assert!(Arc::ptr_eq(&model(&third, "b.obj").mesh, &new.mesh));
}

#[test]
fn meshes_beyond_the_limits_are_refused() {
    let place = Place::new();
    for (name, scale) in [
        ("a.obj", "1"),
        ("b.obj", "2"),
        ("c.obj", "3"),
        ("d.obj", "1"),
    ] {
        place.write(name, TRIANGLE.replace("v 1", &format!("v {scale}")));
    }
    place.write("a.mtl", "newmtl a\n");
    let mut assets = Assets::new(&[]);
    assets.limits.triangles = 2;
    let loaded = assets.read(&place.wanted_meshes(&["a.obj", "b.obj", "c.obj", "d.obj"]));
    // The fourth equals the first.
    assert_eq!(loaded.meshes.unreadable(), 1);
    assert!(matches!(loaded.meshes.get("c.obj"), Some(Err(_))));
}

#[test]
fn a_mesh_named_without_its_extension_is_found_and_watched() {
    let place = Place::new();
    place.write("a.mtl", "newmtl a\n");
    let wanted = place.wanted_meshes(&["a"]);
    let mut assets = Assets::new(&[]);
    let places = [place.at("a"), place.at("a.obj")];
    assert_eq!(assets.places(&wanted), places);
    let looked_for = format!(
        "looked for {}, {}",
        places[0].display(),
        places[1].display()
    );
    let missing = NoMesh::Unread {
        reason: "no such file".to_owned(),
        hint: Some(looked_for),
    };
    let loaded = assets.read(&wanted);
    let fault = loaded.meshes.get("a").and_then(Result::err);
    assert_eq!(fault, Some(&missing));
    place.write("a.obj", TRIANGLE);
    // A folder of this name is no mesh.
    for _ in 0..2 {
        let loaded = assets.read(&wanted);
        assert_eq!(warnings(&loaded, "a"), [""; 0]);
        assert_eq!(loaded.elsewhere["a"], place.at("a.obj"));
        let _ = fs::create_dir(place.at("a"));
    }
    // A file of this name comes first.
    fs::remove_dir(place.at("a")).expect("it is there");
    place.write("a", TRIANGLE);
    assert_eq!(assets.read(&wanted).elsewhere, BTreeMap::new());
}

/// The library of a mesh found in a named folder is found there too.
#[test]
fn a_mesh_from_a_named_folder_uses_the_library_there() {
    let place = Place::new();
    let elsewhere = tempfile::tempdir().expect("a directory");
    fs::create_dir(elsewhere.path().join("meshes")).expect("a folder");
    for folder in ["", "meshes/"] {
        let at = |name: &str| elsewhere.path().join(format!("{folder}{name}"));
        fs::write(at("a.obj"), TRIANGLE).expect("written");
        fs::write(at("a.mtl"), "newmtl a\nKd 0 1 0\n").expect("written");
    }
    for (name, mesh, library) in [
        ("meshes\\a.obj", "meshes/a.obj", "meshes/a.mtl"),
        ("C:\\course\\a.obj", "a.obj", "a.mtl"),
    ] {
        let mut assets = Assets::new(&[elsewhere.path().to_owned()]);
        let loaded = assets.read(&place.wanted_meshes(&[name]));
        assert_eq!(warnings(&loaded, name), [""; 0]);
        let found: Vec<_> = loaded.elsewhere.values().cloned().collect();
        let mut expected = [mesh, library]
            .map(|name| elsewhere.path().join(name))
            .to_vec();
        expected.sort();
        assert_eq!(
            found.iter().collect::<BTreeSet<_>>(),
            expected.iter().collect()
        );
    }
}

/// Files of the same bytes are different meshes if their names say so.
#[test]
fn the_extension_tells_the_format() {
    let place = Place::new();
    let stl = "solid a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n";
    for name in ["a.stl", "b.STL", "c.obj", "d"] {
        place.write(name, stl);
    }
    let names = ["a.stl", "b.STL", "c.obj", "d"];
    let loaded = Assets::new(&[]).read(&place.wanted_meshes(&names));
    let [a, b] = ["a.stl", "b.STL"].map(|name| model(&loaded, name));
    assert!(Arc::ptr_eq(&a, &b));
    for name in ["c.obj", "d"] {
        assert!(
            matches!(loaded.meshes.get(name), Some(Err(NoMesh::Malformed(_)))),
            "{name}"
        );
    }
}

#[test]
fn a_scene_around_a_mesh_has_a_name_of_its_own() {
    let place = Place::new();
    place.write("a.obj", TRIANGLE);
    place.write("a.mtl", "newmtl a\nKd 0 1 0\n");
    let mut assets = Assets::new(&[]);
    let made = assets.scene_of_mesh(&place.at("a.obj"), None);
    assert_eq!(made.path, place.at("a.xml"));
    assert_eq!(
        made.summary,
        "1 triangle, y up, on a ground with two lights"
    );
    assert!(made.is_readable && made.text.contains("name=\"a.obj\"/>"));
    for taken in ["a.xml", "a-2.xml"] {
        place.write(taken, "");
    }
    let made = assets.scene_of_mesh(&place.at("a.obj"), Some(Up::Z));
    assert_eq!(made.path, place.at("a-3.xml"));
    assert!(made.summary.contains("z up"));
    let made = assets.scene_of_mesh(&place.at("none.stl"), None);
    assert!(!made.is_readable && made.text.contains("name=\"none.stl\""));
}
