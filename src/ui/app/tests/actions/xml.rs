//! What each action does to a `.xml` text.

use super::*;

pub(super) const TEXT: &str = "\
<xml>
  <!-- view front: eye 0 0 5 target 0 0 0 up 0 1 0 fov 60 -->
  <scene>
    <!-- ball -->
    <object type=\"sphere\" name=\"a\" material=\"m\">
      <translate x=\"1\"/>
    </object>
    <object type=\"plane\" name=\"b\"/>
    <material type=\"blinn\" name=\"m\">
      <diffuse r=\"1\" g=\"0\" b=\"0\"/>
    </material>
    <material type=\"phong\" name=\"n\"/>
    <light type=\"point\" name=\"lamp\">
      <position y=\"5\"/>
    </light>
    <light type=\"ambient\" name=\"sky\"/>
  </scene>
  <camera>
    <position z=\"10\"/>
    <target value=\"0\"/>
    <up y=\"1\"/>
    <width value=\"400\"/>
    <height value=\"300\"/>
  </camera>
</xml>
";

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    row(Add("sphere"), Object(0), "asphere<Enter>", Becomes(&[
        ("      <translate x=\"1\"/>\n",
            "      <translate x=\"1\"/>\n    </object>\n    <object type=\"sphere\" name=\"sphere\" material=\"m\">\n      <scale value=\"1\"/>\n      <translate x=\"0\" y=\"0\" z=\"0\"/>\n"),
    ])),
    row(Add("plane"), Object(0), "aplane<Enter>", Becomes(&[
        ("      <translate x=\"1\"/>\n",
            "      <translate x=\"1\"/>\n    </object>\n    <object type=\"plane\" name=\"plane\" material=\"m\">\n      <scale value=\"1\"/>\n      <translate x=\"0\" y=\"0\" z=\"0\"/>\n"),
    ])),
    row(Add("mesh"), Object(0), "amesh<Enter>a.obj<Enter>", Becomes(&[
        ("      <translate x=\"1\"/>\n",
            "      <translate x=\"1\"/>\n    </object>\n    <object type=\"obj\" name=\"a.obj\">\n      <scale value=\"1\"/>\n      <translate x=\"0\" y=\"0\" z=\"0\"/>\n"),
    ])),
    row(Command("mesh"), Object(0), ":mesh<Enter>", Says("name the mesh: mesh FILE.obj")),
    row(Command("mesh"), Object(0), ":mesh b.obj<Enter>", Becomes(&[
        ("      <translate x=\"1\"/>\n",
            "      <translate x=\"1\"/>\n    </object>\n    <object type=\"obj\" name=\"b.obj\">\n      <scale value=\"1\"/>\n      <translate x=\"0\" y=\"0\" z=\"0\"/>\n"),
    ])),
    row(Add("group"), Object(0), "agroup<Enter>", Becomes(&[
        ("      <translate x=\"1\"/>\n",
            "      <translate x=\"1\"/>\n    </object>\n    <object name=\"group\">\n      <translate x=\"0\" y=\"0\" z=\"0\"/>\n"),
    ])),
    row(Add("point light"), Object(0), "apoint light<Enter>", Becomes(&[
        ("    <light type=\"ambient\" name=\"sky\"/>\n",
            "    <light type=\"ambient\" name=\"sky\"/>\n    <light type=\"point\" name=\"point\">\n      <intensity value=\"1\"/>\n      <position x=\"0\" y=\"0\" z=\"4\"/>\n    </light>\n"),
    ])),
    row(Add("direct light"), Object(0), "adirect light<Enter>", Becomes(&[
        ("    <light type=\"ambient\" name=\"sky\"/>\n",
            "    <light type=\"ambient\" name=\"sky\"/>\n    <light type=\"direct\" name=\"direct\">\n      <intensity value=\"0.6\"/>\n      <direction x=\"1\" y=\"1\" z=\"-2\"/>\n    </light>\n"),
    ])),
    row(Add("ambient light"), Object(0), "aambient light<Enter>", Becomes(&[
        ("    <light type=\"ambient\" name=\"sky\"/>\n",
            "    <light type=\"ambient\" name=\"sky\"/>\n    <light type=\"ambient\" name=\"ambient\">\n      <intensity value=\"0.2\"/>\n    </light>\n"),
    ])),
    row(Add("blinn material"), Object(0), "ablinn material<Enter>", Becomes(&[
        ("    <material type=\"phong\" name=\"n\"/>\n",
            "    <material type=\"phong\" name=\"n\"/>\n    <material type=\"blinn\" name=\"blinn\">\n      <diffuse r=\"0.7\" g=\"0.7\" b=\"0.7\"/>\n      <specular value=\"0.3\"/>\n    </material>\n"),
    ])),
    row(Add("phong material"), Object(0), "aphong material<Enter>", Becomes(&[
        ("    <material type=\"phong\" name=\"n\"/>\n",
            "    <material type=\"phong\" name=\"n\"/>\n    <material type=\"phong\" name=\"phong\">\n      <diffuse r=\"0.7\" g=\"0.7\" b=\"0.7\"/>\n      <specular value=\"0.3\"/>\n    </material>\n"),
    ])),
    row(Add("microfacet material"), Object(0), "amicrofacet material<Enter>", Becomes(&[
        ("    <material type=\"phong\" name=\"n\"/>\n",
            "    <material type=\"phong\" name=\"n\"/>\n    <material type=\"microfacet\" name=\"microfacet\">\n      <color r=\"0.8\" g=\"0.8\" b=\"0.8\"/>\n      <roughness value=\"0.4\"/>\n    </material>\n"),
    ])),
    row(Key("delete"), Object(0), "d", Becomes(&[
        ("    <object type=\"sphere\" name=\"a\" material=\"m\">\n      <translate x=\"1\"/>\n    </object>\n",
            ""),
    ])),
    row(Key("delete"), Light(1), "d", Becomes(&[
        ("    <light type=\"ambient\" name=\"sky\"/>\n",
            ""),
    ])),
    row(Key("delete"), Object(0), "  d", Becomes(&[
        ("    <object type=\"sphere\" name=\"a\" material=\"m\">\n      <translate x=\"1\"/>\n    </object>\n    <object type=\"plane\" name=\"b\"/>\n",
            ""),
    ])),
    row(Key("delete"), View, "d", Says("view cannot be copied, moved or deleted")),
    row(Key("delete"), Material(0), "dy", Becomes(&[
        ("name=\"a\" material=\"m\">\n",
            "name=\"a\">\n"),
        ("    <material type=\"blinn\" name=\"m\">\n      <diffuse r=\"1\" g=\"0\" b=\"0\"/>\n    </material>\n",
            ""),
    ])),
    row(Key("duplicate"), Object(0), "D", Becomes(&[
        ("    <object type=\"sphere\" name=\"a\" material=\"m\">\n",
            "    <object type=\"sphere\" name=\"a\" material=\"m\">\n      <translate x=\"1\"/>\n    </object>\n    <object type=\"sphere\" name=\"a 2\" material=\"m\">\n"),
    ])),
    row(Key("duplicate"), Light(0), "D", Becomes(&[
        ("    </light>\n",
            "    </light>\n    <light type=\"point\" name=\"lamp 2\">\n      <position y=\"5\"/>\n    </light>\n"),
    ])),
    row(Key("duplicate"), Object(0), "  D", Becomes(&[
        ("    <object type=\"plane\" name=\"b\"/>\n",
            "    <object type=\"plane\" name=\"b\"/>\n    <object type=\"sphere\" name=\"a 2\" material=\"m\">\n      <translate x=\"1\"/>\n    </object>\n    <object type=\"plane\" name=\"b 2\"/>\n"),
    ])),
    row(Key("duplicate"), Material(0), "D", Becomes(&[
        ("    <material type=\"blinn\" name=\"m\">\n",
            "    <material type=\"blinn\" name=\"m\">\n      <diffuse r=\"1\" g=\"0\" b=\"0\"/>\n    </material>\n    <material type=\"blinn\" name=\"m 2\">\n"),
    ])),
    row(Key("reorder-up"), Object(1), "K", Becomes(&[
        ("    <!-- ball -->\n",
            "    <!-- ball -->\n    <object type=\"plane\" name=\"b\"/>\n"),
        ("    </object>\n    <object type=\"plane\" name=\"b\"/>\n",
            "    </object>\n"),
    ])),
    row(Key("reorder-down"), Object(0), "J", Becomes(&[
        ("    <!-- ball -->\n",
            "    <!-- ball -->\n    <object type=\"plane\" name=\"b\"/>\n"),
        ("    </object>\n    <object type=\"plane\" name=\"b\"/>\n",
            "    </object>\n"),
    ])),
    row(Key("reorder-down"), Light(0), "J", Becomes(&[
        ("    <material type=\"phong\" name=\"n\"/>\n",
            "    <material type=\"phong\" name=\"n\"/>\n    <light type=\"ambient\" name=\"sky\"/>\n"),
        ("    </light>\n    <light type=\"ambient\" name=\"sky\"/>\n",
            "    </light>\n"),
    ])),
    row(Key("reorder-up"), Object(0), "K", Says("a (sphere) is already the first")),
    row(Key("reorder-down"), Material(0), "J", Becomes(&[
        ("    <object type=\"plane\" name=\"b\"/>\n",
            "    <object type=\"plane\" name=\"b\"/>\n    <material type=\"phong\" name=\"n\"/>\n"),
        ("    </material>\n    <material type=\"phong\" name=\"n\"/>\n",
            "    </material>\n"),
    ])),
    row(Key("paste"), Object(0), "yjp", Becomes(&[
        ("    <object type=\"plane\" name=\"b\"/>\n",
            "    <object type=\"plane\" name=\"b\"/>\n    <object type=\"sphere\" name=\"a 2\" material=\"m\">\n      <translate x=\"1\"/>\n    </object>\n"),
    ])),
    row(Key("paste"), Object(0), "  yp", Becomes(&[
        ("    <object type=\"plane\" name=\"b\"/>\n",
            "    <object type=\"plane\" name=\"b\"/>\n    <object type=\"sphere\" name=\"a 2\" material=\"m\">\n      <translate x=\"1\"/>\n    </object>\n    <object type=\"plane\" name=\"b 2\"/>\n"),
    ])),
    row(Key("paste"), Object(0), "p", Says("nothing to paste: y copies the selected item")),
    row(Key("rename"), Object(0), "R<Ctrl-u>9<Enter>", Becomes(&[
        ("name=\"a\" ",
            "name=\"9\" "),
    ])),
    row(Key("rename"), Material(0), "R<Ctrl-u>8<Enter>", Becomes(&[
        ("material=\"m\">\n",
            "material=\"8\">\n"),
        ("name=\"m\">\n",
            "name=\"8\">\n"),
    ])),
    row(Key("rename"), Light(0), "R<Ctrl-u>7<Enter>", Becomes(&[
        ("name=\"lamp\">\n",
            "name=\"7\">\n"),
    ])),
    row(Key("visibility"), Object(0), "h", Says("an .xml scene draws all of its objects")),
    row(Key("visibility"), Object(0), "  h", Says("an .xml scene draws all of its objects")),
    row(Key("change-type"), Object(0), "cplane<Enter>", Becomes(&[
        ("type=\"sphere\" ",
            "type=\"plane\" "),
    ])),
    row(Key("change-type"), Material(0), "cphong<Enter>", Becomes(&[
        ("type=\"blinn\" ",
            "type=\"phong\" "),
    ])),
    row(Key("change-type"), Light(0), "cdirect<Enter>", Becomes(&[
        ("type=\"point\" ",
            "type=\"direct\" "),
    ])),
    row(Key("move"), Object(0), "mx2<Enter>", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"3\"/>\n"),
    ])),
    row(Key("move"), Object(0), "  my1<Enter>", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"1\" y=\"1\"/>\n"),
        ("    <object type=\"plane\" name=\"b\"/>\n",
            "    <object type=\"plane\" name=\"b\">\n      <translate y=\"1\"/>\n    </object>\n"),
    ])),
    row(Key("move"), Light(0), "mz-5<Enter>", Becomes(&[
        ("y=\"5\"/>\n",
            "y=\"5\" z=\"-5\"/>\n"),
    ])),
    row(Key("move"), Object(0), "ml<Enter>", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"1.2\"/>\n"),
    ])),
    row(Key("move"), View, "mx1<Enter>", Becomes(&[
        ("z=\"10\"/>", "z=\"10\" x=\"1\"/>"),
        ("<target value=\"0\"/>", "<target value=\"1\" x=\"1\" y=\"0\" z=\"0\"/>"),
    ])),
    row(Key("rotate"), Object(1), "tz90<Enter>", Becomes(&[
        ("    <object type=\"plane\" name=\"b\"/>\n",
            "    <object type=\"plane\" name=\"b\">\n      <rotate z=\"1\" angle=\"90\"/>\n    </object>\n"),
    ])),
    row(Key("rotate"), Object(0), "  tz90<Enter>", Becomes(&[
        ("      <translate x=\"1\"/>\n",
            "      <rotate z=\"1\" angle=\"90\"/>\n      <translate x=\"0\" y=\"1\"/>\n"),
        ("    <object type=\"plane\" name=\"b\"/>\n",
            "    <object type=\"plane\" name=\"b\">\n      <rotate z=\"1\" angle=\"90\"/>\n    </object>\n"),
    ])),
    row(Key("scale"), Object(0), "s2<Enter>", Becomes(&[
        ("    <object type=\"sphere\" name=\"a\" material=\"m\">\n",
            "    <object type=\"sphere\" name=\"a\" material=\"m\">\n      <scale value=\"2\"/>\n"),
    ])),
    row(Key("scale"), Object(1), "syy2<Enter>", Becomes(&[
        ("    <object type=\"plane\" name=\"b\"/>\n",
            "    <object type=\"plane\" name=\"b\">\n      <scale y=\"2\"/>\n    </object>\n"),
    ])),
    row(Key("scale"), Object(0), "  s2<Enter>", Becomes(&[
        ("      <translate x=\"1\"/>\n",
            "      <scale value=\"2\"/>\n      <translate x=\"2\"/>\n"),
        ("    <object type=\"plane\" name=\"b\"/>\n",
            "    <object type=\"plane\" name=\"b\">\n      <scale value=\"2\"/>\n    </object>\n"),
    ])),
    row(Key("nudge-up"), Object(0), "ejjjjl", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"1.1\"/>\n"),
    ])),
    row(Key("nudge-down"), Object(0), "ejjjjh", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"0.9\"/>\n"),
    ])),
    row(Key("nudge-up-coarse"), Object(0), "ejjjjL", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"2\"/>\n"),
    ])),
    row(Key("nudge-down-coarse"), Object(0), "ejjjjH", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"0\"/>\n"),
    ])),
    row(Key("nudge-up-fine"), Object(0), "ejjjj<Alt-l>", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"1.01\"/>\n"),
    ])),
    row(Key("nudge-down-fine"), Object(0), "ejjjj<Alt-h>", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"0.99\"/>\n"),
    ])),
    row(Key("type"), Object(0), "ejjjj3<Enter>", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"3\"/>\n"),
    ])),
    row(Key("type"), Object(0), "ejjjj<Enter><Ctrl-u>1/4<Enter>", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"0.25\"/>\n"),
    ])),
    row(Key("type"), Object(0), "ejjjj+=1<Enter>", Becomes(&[
        ("x=\"1\"/>\n",
            "x=\"2\"/>\n"),
    ])),
    row(Key("type"), Object(0), "  kejj<Enter>n<Enter>", Becomes(&[
        ("material=\"m\">\n",
            "material=\"n\">\n"),
        ("name=\"b\"/>\n",
            "name=\"b\" material=\"n\"/>\n"),
    ])),
    row(Word, Object(0), "ejj<Enter>n<Enter>", Becomes(&[
        ("material=\"m\">\n",
            "material=\"n\">\n"),
    ])),
    row(Key("choose"), Object(0), "ejj<Enter>n<Enter>", Becomes(&[
        ("material=\"m\">\n",
            "material=\"n\">\n"),
    ])),
    row(Key("choose"), Object(0), "ejj<Enter>new<Enter>", Becomes(&[
        ("material=\"m\">", "material=\"new\">"),
        ("name=\"n\"/>\n",
            "name=\"n\"/>\n    <material type=\"blinn\" name=\"new\">\n      <diffuse r=\"0.7\" g=\"0.7\" b=\"0.7\"/>\n      <specular value=\"0.3\"/>\n    </material>\n"),
    ])),
    row(Key("pick-colour"), Material(0), "ejjcjjH<Enter>", Becomes(&[
        ("r=\"1\"",
            "r=\"0.8\""),
    ])),
    row(Key("orthonormalise"), Object(0), "eO", Says("a (sphere) has no frame to orthonormalise")),
    row(Key("write-view"), Object(0), "vlS", Becomes(&[
        ("z=\"10\"/>\n",
            "z=\"9.9619\" x=\"0.8716\"/>\n"),
    ])),
    row(Key("write-view"), Object(0), "vlqS<Esc>", Becomes(&[
        ("z=\"10\"/>\n",
            "z=\"9.9619\" x=\"0.8716\"/>\n"),
    ])),
    row(Command("view save"), Object(0), ":view save side<Enter>", Becomes(&[
        ("</xml>\n",
            "</xml>\n<!-- view side: eye 0 0 10 target 0 0 0 up 0 1 0 fov 40 -->\n"),
    ])),
    row(Command("view save"), Object(0), "vl:view save<Enter>", Becomes(&[
        ("z=\"10\"/>\n",
            "z=\"9.9619\" x=\"0.8716\"/>\n"),
    ])),
    row(Command("size"), Object(0), ":size 320x200<Enter>", Becomes(&[
        ("    <width value=\"400\"/>\n    <height value=\"300\"/>\n",
            "    <width value=\"320\"/>\n    <height value=\"200\"/>\n"),
    ])),
    row(Key("cure"), Object(0), "C", Says("there is no render setting to suggest")),
    row(Command("set"), Object(0), ":set depth 3<Enter>", Becomes(&[
        ("  </camera>\n",
            "  </camera>\n  <render depth=\"3\"/>\n"),
    ])),
    row(Key("delete-view"), Object(0), "vVd<Esc>", Becomes(&[
        ("  <!-- view front: eye 0 0 5 target 0 0 0 up 0 1 0 fov 60 -->\n",
            ""),
    ])),
];
