//! What each action does to a `.xml` text.

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

/// Parts of [`TEXT`], and changes of it, by the names that rows give them in braces.
pub(super) const NAMES: &str = r#"
    ball   | \s   <object type="sphere" name="a" material="m">\n      <translate x="1"/>\n    </object>\n
    plane  | \s   <object type="plane" name="b"/>\n
    phong  | \s   <material type="phong" name="n"/>\n
    sky    | \s   <light type="ambient" name="sky"/>\n
    blinn  | \s   <material type="blinn" name="m">\n      <diffuse r="1" g="0" b="0"/>\n    </material>\n
    copy   | \s   <object type="sphere" name="a 2" material="m">\n      <translate x="1"/>\n    </object>\n
    shift  | \s     <translate x="1"/>\n
    place  | \n      <scale value="1"/>\n      <translate x="0" y="0" z="0"/>\n
    shine  | \n      <diffuse r="0.7" g="0.7" b="0.7"/>\n      <specular value="0.3"/>\n    </material>\n
    planes | \s   <object type="plane" name="b">\n
"#;

pub(super) const ROWS: &str = r#"
    add sphere | object 1 | asphere<Enter> | {shift} +> \s   </object>\n    <object type="sphere" name="sphere" material="m">{place}
    add plane | object 1 | aplane<Enter> | {shift} +> \s   </object>\n    <object type="plane" name="plane" material="m">{place}
    add mesh | object 1 | amesh<Enter>a.obj<Enter> | {shift} +> \s   </object>\n    <object type="obj" name="a.obj">{place}
    :mesh | object 1 | :mesh<Enter> | says name the mesh: :mesh FILE.obj
    :mesh | object 1 | :mesh b.obj<Enter> | {shift} +> \s   </object>\n    <object type="obj" name="b.obj">{place}
    add group | object 1 | agroup<Enter>
        | {shift} +> \s   </object>\n    <object name="group">\n      <translate x="0" y="0" z="0"/>\n
    add point light | object 1 | apoint light<Enter>
        | {sky} +> \s   <light type="point" name="point">\n      <intensity value="1"/>\n      <position x="0" y="0" z="4"/>\n    </light>\n
    add direct light | object 1 | adirect light<Enter>
        | {sky} +> \s   <light type="direct" name="direct">\n      <intensity value="0.6"/>\n      <direction x="1" y="1" z="-2"/>\n    </light>\n
    add ambient light | object 1 | aambient light<Enter>
        | {sky} +> \s   <light type="ambient" name="ambient">\n      <intensity value="0.2"/>\n    </light>\n
    add blinn material | object 1 | ablinn material<Enter> | {phong} +> \s   <material type="blinn" name="blinn">{shine}
    add phong material | object 1 | aphong material<Enter> | {phong} +> \s   <material type="phong" name="phong">{shine}
    add microfacet material | object 1 | amicrofacet material<Enter>
        | {phong} +> \s   <material type="microfacet" name="microfacet">\n      <color r="0.8" g="0.8" b="0.8"/>\n      <roughness value="0.4"/>\n    </material>\n
    delete | object 1 | d | {ball} =>
    delete | light 2 | d | {sky} =>
    delete | object 1 | <Space><Space>d | {ball}{plane} =>
    delete | view | d | says view cannot be copied, moved or deleted
    delete | material 1 | dy | name="a" material="m">\n => name="a">\n & {blinn} =>
    duplicate | object 1 | D
        | \s   <object type="sphere" name="a" material="m">\n +> {shift}    </object>\n    <object type="sphere" name="a 2" material="m">\n
    duplicate | light 1 | D | \s   </light>\n +> \s   <light type="point" name="lamp 2">\n      <position y="5"/>\n    </light>\n
    duplicate | object 1 | <Space><Space>D | {plane} +> {copy}    <object type="plane" name="b 2"/>\n
    duplicate | material 1 | D
        | \s   <material type="blinn" name="m">\n +> \s     <diffuse r="1" g="0" b="0"/>\n    </material>\n    <material type="blinn" name="m 2">\n
    reorder-up | object 2 | K | \s   <!-- ball -->\n +> {plane} & \s   </object>\n{plane} => \s   </object>\n
    reorder-down | object 1 | J | \s   <!-- ball -->\n +> {plane} & \s   </object>\n{plane} => \s   </object>\n
    reorder-down | light 1 | J | {phong} +> {sky} & \s   </light>\n{sky} => \s   </light>\n
    reorder-up | object 1 | K | says a (sphere) is already the first
    reorder-down | material 1 | J | {plane} +> {phong} & \s   </material>\n{phong} => \s   </material>\n
    paste | object 1 | yjp | {plane} +> {copy}
    paste | object 1 | <Space><Space>yp | {plane} +> {copy}    <object type="plane" name="b 2"/>\n
    paste | object 1 | p | says nothing to paste: y copies the selected item
    rename | object 1 | R<Ctrl-u>9<Enter> | name="a"\s => name="9"\s
    rename | material 1 | R<Ctrl-u>8<Enter> | material="m">\n => material="8">\n & name="m">\n => name="8">\n
    rename | light 1 | R<Ctrl-u>7<Enter> | name="lamp">\n => name="7">\n
    visibility | object 1 | h | says .xml cannot hide objects
    visibility | object 1 | <Space><Space>h | says .xml cannot hide objects
    change-type | object 1 | cplane<Enter> | type="sphere"\s => type="plane"\s
    change-type | material 1 | cphong<Enter> | type="blinn"\s => type="phong"\s
    change-type | light 1 | cdirect<Enter> | type="point"\s => type="direct"\s
    move | object 1 | mx2<Enter> | x="1"/>\n => x="3"/>\n
    move | object 1 | <Space><Space>my1<Enter>
        | x="1"/>\n => x="1" y="1"/>\n & {plane} => {planes}      <translate y="1"/>\n    </object>\n
    move | light 1 | mz-5<Enter> | y="5"/>\n => y="5" z="-5"/>\n
    move | object 1 | ml<Enter> | x="1"/>\n => x="1.2"/>\n
    move | view | mx1<Enter> | z="10"/> => z="10" x="1"/> & <target value="0"/> => <target value="1" x="1" y="0" z="0"/>
    rotate | object 2 | tz90<Enter> | {plane} => {planes}      <rotate z="1" angle="90"/>\n    </object>\n
    rotate | object 1 | <Space><Space>tz90<Enter>
        | {shift} => \s     <rotate z="1" angle="90"/>\n      <translate x="0" y="1"/>\n
        & {plane} => {planes}      <rotate z="1" angle="90"/>\n    </object>\n
    scale | object 1 | s2<Enter> | \s   <object type="sphere" name="a" material="m">\n +> \s     <scale value="2"/>\n
    scale | object 2 | syy2<Enter> | {plane} => {planes}      <scale y="2"/>\n    </object>\n
    scale | object 1 | <Space><Space>s2<Enter>
        | {shift} => \s     <scale value="2"/>\n      <translate x="2"/>\n
        & {plane} => {planes}      <scale value="2"/>\n    </object>\n
    nudge-up | object 1 | ejjjjl | x="1"/>\n => x="1.1"/>\n
    nudge-down | object 1 | ejjjjh | x="1"/>\n => x="0.9"/>\n
    nudge-up-coarse | object 1 | ejjjjL | x="1"/>\n => x="2"/>\n
    nudge-down-coarse | object 1 | ejjjjH | x="1"/>\n => x="0"/>\n
    nudge-up-fine | object 1 | ejjjj<Alt-l> | x="1"/>\n => x="1.01"/>\n
    nudge-down-fine | object 1 | ejjjj<Alt-h> | x="1"/>\n => x="0.99"/>\n
    type | object 1 | ejjjj3<Enter> | x="1"/>\n => x="3"/>\n
    type | object 1 | ejjjj<Enter><Ctrl-u>1/4<Enter> | x="1"/>\n => x="0.25"/>\n
    type | object 1 | ejjjj+=1<Enter> | x="1"/>\n => x="2"/>\n
    type | object 1 | <Space><Space>kejj<Enter>n<Enter>
        | material="m">\n => material="n">\n & name="b"/>\n => name="b" material="n"/>\n
    word | object 1 | ejj<Enter>n<Enter> | material="m">\n => material="n">\n
    choose | object 1 | ejj<Enter>n<Enter> | material="m">\n => material="n">\n
    choose | object 1 | ejj<Enter>new<Enter>
        | material="m"> => material="new"> & name="n"/>\n +> \s   <material type="blinn" name="new">{shine}
    pick-colour | material 1 | ejjcjjH<Enter> | r="1" => r="0.8"
    orthonormalise | object 1 | eO | says a (sphere) has no frame to orthonormalise
    write-view | object 1 | vlS | z="10"/>\n => z="9.9619" x="0.8716"/>\n
    write-view | object 1 | vlqS<Esc> | z="10"/>\n => z="9.9619" x="0.8716"/>\n
    :view save | object 1 | :view save side<Enter>
        | </xml>\n => </xml>\n<!-- view side: eye 0 0 10 target 0 0 0 up 0 1 0 fov 40 -->\n
    :view save | object 1 | vl:view save<Enter> | z="10"/>\n => z="9.9619" x="0.8716"/>\n
    :size | object 1 | :size 320x200<Enter>
        | \s   <width value="400"/>\n    <height value="300"/>\n => \s   <width value="320"/>\n    <height value="200"/>\n
    cure | object 1 | C | says no suggestion for this scene
    :set | object 1 | :set depth 3<Enter> | \s </camera>\n +> \s <render depth="3"/>\n
    delete-view | object 1 | vVd<Esc> | \s <!-- view front: eye 0 0 5 target 0 0 0 up 0 1 0 fov 60 -->\n =>
"#;
