//! Features of `.xml` that the others lack: components that are absent from the text.

use super::scripts::{Stage, scene, scripts};
use super::*;
use crate::app::{Provenance, display};

const SCENE: &str = r#"<xml>
  <scene>
    <object name="all">
      <object type="sphere" name="ball" material='m'>
        <scale value="2"/>
      </object>
    </object>
    <material name="m"/>
  </scene>
  <camera>
    <position z="9"/>
    <target/>
  </camera>
</xml>
"#;

fn xml<'s>() -> Stage<'s> {
    scene("scene.xml", SCENE)
}

scripts! {
    defaults_are_shown_and_written_when_typed: {
        let mut session = xml().session();
        session.run("[object 2]");
        let rows = session.app.shared.fields();
        let scale = rows.iter().find(|row| row.field.key == "scale");
        let scale = scale.expect("it is scaled");
        assert_eq!(scale.literals, ["1", "1", "1", "2"]);
        let [unsaid, said] = [Provenance::Default, Provenance::Text];
        assert_eq!(scale.sources, [unsaid, unsaid, unsaid, said]);
        xml().table(r"
            [{1}] {2} | text {3}
            <Esc>uuu  | text opened
        ", r#"
            object 2 | ejjj<Tab>i<Back>3<Enter> | <scale value="2"/> => <scale value="2" y="3"/>
            object 2 | ejjjl   | <scale value="2"/> => <scale value="2" x="1.1"/>
            object 2 | ejjjll  | <scale value="2"/> => <scale value="2" x="1.2"/>
            object 2 | eji<Back><Back><Back><Back>a&b<Enter> | "ball" => "a&amp;b"
            // A missing parameter is added.
            material 1 | ejji<Back><Back><Back>1<Enter> | <material name="m"/> => <material name="m">\n      <diffuse r="1" g="0.5" b="0.5"/>\n    </material>
            view     | ejjjl   | <target/> => <target/>\n    <fov value="41"/>
            view     | :size 320x210<Enter> | <target/> => <target/>\n    <width value="320"/>\n    <height value="210"/>
        "#);
    };

    nudging_a_material_cycles_through_existing_names: xml()
        .but(r#"name="m"/> => name="m"/><material name="n &amp; o"/>"#)
        .play(r#"
        [object 2] ejj
        l | text material='m' => material='n &amp; o'
        l | text opened
        h | text material='m' => material='n &amp; o'
        [object 1] jjl | text …name="all" material="m">…
    "#);

    a_moved_view_is_saved: xml().play("[view] vllS | not moved | lines …<position z=… x=…");

    a_colour_pasted_onto_a_missing_one_is_written_at_once: xml().play(r#"
        [material 1] ejj
        @paste #ff8000 | text …<diffuse r="1" g="0.502" b="0"/>…
        <Esc>u         | text opened
    "#);
}

/// A text that is not XML has no nodes, and no key has any effect on it.
#[test]
fn a_text_that_is_not_xml_does_no_harm() {
    for text in ["", "<xml>", "<xml><scene></xml>", "<scene/>"] {
        let mut app = opened_as("scene.xml", text).0;
        assert!(
            app.shared.nodes().is_empty() && 0 < app.shared.error_count(),
            "{text}"
        );
        let keys = "jkgG e jk<Tab>hl i1<Enter> <Esc> nN /x<Enter> v hjkl+-[]f0S <Esc> p <Enter> <Esc> o<Space> ! \
                    j<Enter> <Esc> u :size<Space>9x9<Enter> :view<Space>save<Enter> b <Esc>";
        for keys in keys.split(' ') {
            press(&mut app, keys);
            assert!(app.shared.fields().is_empty() && app.shared.cursor.parts().is_empty());
            let _ = (
                app.shared.areas(),
                app.shared.raster(),
                display::outlined_objects(&app.shared),
            );
        }
        assert_eq!(app.shared.document.text(), text);
    }
}
