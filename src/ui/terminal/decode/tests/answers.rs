//! What terminals answer to the questions of any program: whatever of it arrives here, whenever and
//! in whatever pieces, none of its bytes is a key.

use proptest::prelude::*;

use super::*;

/// Answers by their names, in the seven-bit form.
const ANSWERS: &[(&str, &[u8])] = &table! {
    "DA1 of a VT100" => b"\x1b[?1;2c";
    "DA1 with sixel" => b"\x1b[?62;4;9;22c";
    "DA2" => b"\x1b[>41;390;0c";
    "DA3" => b"\x1bP!|7E565445\x1b\\";
    "DSR" => b"\x1b[0n";
    "DSR, malfunction" => b"\x1b[3n";
    "DSR of a printer" => b"\x1b[?13n";
    "DSR of the keyboard" => b"\x1b[?27;1;0;0n";
    "DSR of the macro space" => b"\x1b[0*{";
    "DECCKSR" => b"\x1bP1!~ABCD\x1b\\";
    "colour scheme" => b"\x1b[?997;1n";
    "CPR" => b"\x1b[12;40R";
    "CPR at home" => b"\x1b[1;1R";
    "CPR in the first row" => b"\x1b[1;5R";
    "DECXCPR" => b"\x1b[?12;40;1R";
    "DECRPM" => b"\x1b[?2026;2$y";
    "DECRPM of an ANSI mode" => b"\x1b[4;1$y";
    "DECRQSS of SGR" => b"\x1bP1$r0;38:2::49:73:87m\x1b\\";
    "DECRQSS of margins" => b"\x1bP1$r1;24r\x1b\\";
    "DECRQSS of the cursor" => b"\x1bP1$r2 q\x1b\\";
    "DECRQSS, invalid" => b"\x1bP0$r\x1b\\";
    "DECREQTPARM" => b"\x1b[2;1;1;128;128;1;0x";
    "DECTABSR" => b"\x1bP2$u9/17/25\x1b\\";
    "DECCIR" => b"\x1bP1$u1;1;1;@;@;@;0;2;@;BB%5%5\x1b\\";
    "DECLRP" => b"\x1b[1;0;5;10;0&w";
    "DECRPDE" => b"\x1b[24;80;1;1;1\"w";
    "XTGETTCAP" => b"\x1bP1+r524742=38\x1b\\";
    "XTGETTCAP, unknown" => b"\x1bP0+r5463\x1b\\";
    "XTVERSION" => b"\x1bP>|quit(390)\x1b\\";
    "XTSMGRAPHICS" => b"\x1b[?2;0;800;600S";
    "XTQMODKEYS" => b"\x1b[>4;2m";
    "window state" => b"\x1b[1t";
    "window position" => b"\x1b[3;100;200t";
    "window size" => b"\x1b[4;600;800t";
    "cell size" => b"\x1b[6;20;9t";
    "size in cells" => b"\x1b[8;40;120t";
    "size change in the band" => b"\x1b[48;40;120;800;1080t";
    "icon label" => b"\x1b]Ldd - sh\x1b\\";
    "title" => b"\x1b]lquit:w! x\x1b\\";
    "title with signs" => b"\x1b]l\xe2\x9c\xb3 d\xc3\x9c q\x1b\\";
    "OSC 4" => b"\x1b]4;0;rgb:00/00/00\x07";
    "OSC 10" => b"\x1b]10;rgb:dddd/dddd/dddd\x1b\\";
    "OSC 11" => b"\x1b]11;rgb:1e1e/1e1e/2e2e\x07";
    "OSC 12" => b"\x1b]12;#ffffff\x07";
    "OSC 21, kitty's colours" => b"\x1b]21;foreground=rgb:ff/ff/ff\x1b\\";
    "OSC 50" => b"\x1b]50;fixed\x07";
    "OSC 52" => b"\x1b]52;c;ZGRkZGQ=\x1b\\";
    "OSC 60" => b"\x1b]60;allowColorOps\x1b\\";
    "OSC 99" => b"\x1b]99;i=1:p=close;dd\x1b\\";
    "OSC 1337, size of a cell" => b"\x1b]1337;ReportCellSize=20.0;9.0;2.0\x1b\\";
    "OSC 1337, a variable" => b"\x1b]1337;ReportVariable=ZGRkZA==\x07";
    "OSC 5522" => b"\x1b]5522;type=read:status=DATA;ZGRk\x1b\\";
    "kitty's pictures" => b"\x1b_Gi=31;OK\x1b\\";
    "kitty's pictures, refused" => b"\x1b_Gi=31;ENOENT:dd\x1b\\";
    "another APC" => b"\x1b_dqd\x1b\\";
    "PM" => b"\x1b^dqd\x1b\\";
    "SOS" => b"\x1bXdqd\x1b\\";
    "kitty's keys" => b"\x1b[?5u";
    "kitty's cursors" => b"\x1b[>1;29;2 q";
    "focus gained" => b"\x1b[I";
    "focus lost" => b"\x1b[O";
    "mouse, SGR" => b"\x1b[<0;10;20M";
    "mouse, released" => b"\x1b[<0;10;20m";
    "mouse, moved" => b"\x1b[<35;10;20M";
    "mouse, X10" => b"\x1b[M dq";
    "mouse, urxvt" => b"\x1b[32;10;20M";
    "release of a kitty key" => b"\x1b[100;1:3u";
    "a modifier as a kitty key" => b"\x1b[57441;2u";
    "a key with Super" => b"\x1b[100;9u";
    "end of a paste" => b"\x1b[201~";
    "a sequence longer than any" =>
        b"\x1b[?1;2;3;4;5;6;7;8;9;10;11;12;13;14;15;16;17;18;19;20;21;22;23;24;25;26;27;28;29;30c";
};

/// Feeds pieces with pauses in between and then an x; returns the keys with spaces between them.
fn keys_of<'b>(pieces: impl IntoIterator<Item = &'b [u8]>, pause: Duration) -> String {
    let mut now = Instant::now();
    let mut decoder = Decoder::default();
    let mut keys = Vec::new();
    let mut note = |event| {
        if let Event::Key(key) = event {
            keys.push(key.code.to_string());
        }
    };
    for piece in pieces {
        decoder.expire(now, &mut note);
        decoder.feed(piece, now, &mut note);
        assert!(decoder.held.capacity() <= 4 * LONGEST_STRING);
        now += pause;
    }
    decoder.feed(b"x", now, &mut note);
    assert_eq!(decoder.deadline(), None, "nothing is held");
    keys.join(" ")
}

/// The form with a single byte for each escape sequence of two.
fn eight_bit(bytes: &[u8]) -> Vec<u8> {
    let mut short = Vec::new();
    let mut left = bytes.iter();
    while let Some(&byte) = left.next() {
        short.push(match byte {
            0x1b => left.next().expect("a sequence") + 0x40,
            byte => byte,
        });
    }
    short
}

#[test]
fn no_answer_types_a_key() {
    let (none, short, long) = (0, 24, 1999);
    let pause = Duration::from_millis;
    for &(name, seven_bit) in ANSWERS {
        for (bytes, introducer) in [(seven_bit, 2), (&eight_bit(seven_bit)[..], 1)] {
            assert_eq!(keys_of([bytes], pause(none)), "x", "{name}");
            for milliseconds in [none, short] {
                let pieces = bytes.chunks(1);
                let keys = keys_of(pieces, pause(milliseconds));
                assert_eq!(keys, "x", "{name} every {milliseconds} ms");
            }
            // After the introducer, the rest may take its time.
            for at in introducer..bytes.len() {
                let (head, tail) = bytes.split_at(at);
                let keys = keys_of([head, tail], pause(long));
                assert_eq!(keys, "x", "{name} cut at {at}");
            }
        }
    }
}

#[test]
fn all_answers_at_once_type_no_key() {
    let all: Vec<_> = ANSWERS.iter().map(|(_, bytes)| *bytes).collect();
    let all = all.concat();
    for each in [1, 2, 3, 5, 7, 64, all.len()] {
        let keys = keys_of(all.chunks(each), Duration::ZERO);
        assert_eq!(keys, "x", "by {each}");
    }
}

#[test]
fn a_string_ends_with_its_terminator_or_a_pause() {
    let seven_bit = [&b"\x1bP"[..], b"\x1b]", b"\x1b_", b"\x1b^", b"\x1bX"];
    for introducer in seven_bit.into_iter().chain([&b"\x90"[..], b"\x9d"]) {
        let is_system = introducer.ends_with(b"]") || introducer == b"\x9d";
        for (rest, pause, keys) in table! {
            &[&b"d\x1b\\q"[..]][..], 0 => "q x";
            &[b"d\x9cq"], 0 => "q x";
            &[b"d\x18q"], 0 => "q x";
            &[b"d\x1aq"], 0 => "q x";
            &[b"d\x1b\x1b\\q"], 0 => "q x";
            &[b"d\x1b", b"\\q"], 1999 => "q x";
            &[b"d\r\x03q\x9e", b"\x1b\\"], 1999 => "x";
            // The eight-bit terminator and introducers within characters.
            &[b"\xe2\x9c\xb3q", b"\xc3\x9cq", b"\xf0\x9f\x9c\x9cq\x9c"], 0 => "x";
            &[b"d\x07q\x9c"], 0 => if is_system { "q x" } else { "x" };
            // A pause of two seconds.
            &[b"d", b"q"], 2000 => "q x";
            &[b"d\x1b", b"q"], 2000 => "q x";
            // Another sequence interrupts the string.
            &[b"d\x1b[A"], 0 => "Up x";
            &[b"d\x1b]q\x07"], 0 => "x";
        } {
            let pieces = [&[introducer][..], rest].concat();
            let first = [pieces[0], pieces[1]].concat();
            let pieces = [&[&first[..]][..], &pieces[2..]].concat();
            let shown = introducer.escape_ascii();
            let found = keys_of(pieces, Duration::from_millis(pause));
            assert_eq!(found, keys, "{shown} {rest:?}");
        }
    }
}

/// Alt with the character of an introducer, if nothing else follows in time.
#[test]
fn an_introducer_alone_is_a_key() {
    for (bytes, key) in [
        (&b"\x1b]"[..], "ALT+']'"),
        (b"\x1bP", "SHIFT+ALT+'P'"),
        (b"\x1b_", "ALT+'_'"),
        (b"\x1b^", "ALT+'^'"),
        (b"\x1bX", "SHIFT+ALT+'X'"),
        (b"\x1b[", "ALT+'['"),
        (b"\x1bO", "SHIFT+ALT+'O'"),
    ] {
        assert_eq!(decode(&[(0, bytes)]), key);
        let later = decode(&[(0, bytes), (2000, b"x")]);
        assert_eq!(later, format!("{key} 'x'"));
        // The Esc key and the character, typed one after the other.
        let (escape, character) = bytes.split_at(1);
        let typed = decode(&[(0, escape), (25, character), (50, b"x")]);
        assert!(typed.starts_with("Esc "), "{typed}");
        assert_eq!(typed.split(' ').count(), 3, "{typed}");
    }
    assert_eq!(decode(&[(0, b"\x1b]\x1b[A")]), "ALT+']' Up");
    assert_eq!(decode(&[(0, b"\x9d"), (2000, b"x")]), "'x'");
}

#[test]
fn eight_bit_introducers_count_only_outside_a_character() {
    for (bytes, keys) in [
        (&b"\x9b12;40Rx"[..], "'x'"),
        (b"\x8fPx", "F(1) 'x'"),
        ("\u{15d}d".as_bytes(), "'\u{15d}' 'd'"),
        ("\u{9d}d".as_bytes(), "'d'"),
        (b"\xe2\x9dd", "'d'"),
        (b"\xe0\x9dd", "'d'"),
        (b"\x80\x9c\xa0d", "'d'"),
    ] {
        let typed = decode(&[(0, bytes)]);
        assert_eq!(typed, keys, "{}", bytes.escape_ascii());
    }
    // A character may come in pieces.
    let typed = decode(&[(0, b"\xc5"), (500, b"\x9dd")]);
    assert_eq!(typed, "'\u{15d}' 'd'");
}

#[test]
fn endless_strings_take_no_memory() {
    let piece = vec![b'd'; 1 << 16];
    for introducer in [b"\x1bP", b"\x1b]", b"\x1b_", b"\x1b^", b"\x1bX", b"\x1b["] {
        let pieces = std::iter::once(&introducer[..]).chain([&piece[..]; 16]);
        let pieces = pieces.chain([&b"\x1b\\"[..]]);
        let keys = keys_of(pieces, Duration::from_millis(20));
        // The first letter ends a control sequence.
        if introducer != b"\x1b[" {
            assert_eq!(keys, "x");
        }
    }
}

/// The content of a string: text, and bytes that are no characters.
fn content() -> impl Strategy<Value = Vec<u8>> {
    let character = any::<char>().prop_filter("ends no string", |c| !c.is_ascii_control());
    let part = prop_oneof![
        character.prop_map(|character| character.to_string().into_bytes()),
        (0x9d..=0xff_u8).prop_map(|byte| vec![byte, b'd']),
        Just(b"\r".to_vec()),
    ];
    proptest::collection::vec(part, 0..40).prop_map(|parts| parts.concat())
}

/// Bytes that often are parts of sequences.
fn input() -> impl Strategy<Value = Vec<u8>> {
    let part = prop_oneof![
        proptest::sample::select(b"\x1b[]OPX_^\\;0123:?<>uMRmtx~\x07\x18\x9b\x9c\x9d".to_vec())
            .prop_map(|byte| vec![byte]),
        proptest::sample::select(ANSWERS).prop_map(|(_, bytes)| bytes.to_vec()),
        any::<u8>().prop_map(|byte| vec![byte]),
    ];
    proptest::collection::vec(part, 0..40).prop_map(|parts| parts.concat())
}

proptest! {
    #![proptest_config(repeatable::config())]

    #[test]
    fn no_byte_of_a_string_is_a_key(
        introducer in proptest::sample::select(b"P]_^X".to_vec()),
        content in content(),
        each in 1..40_usize,
    ) {
        let string = [&[0x1b, introducer], &content[..], b"\x1b\\"].concat();
        let keys = keys_of(string.chunks(each), Duration::from_millis(20));
        prop_assert_eq!(keys, "x");
    }

    #[test]
    fn pieces_decode_like_the_whole(input in input(), each in 1..20_usize) {
        let whole = decode(&[(0, &input)]);
        let pieces: Vec<_> = input.chunks(each).map(|piece| (0, piece)).collect();
        prop_assert_eq!(decode(&pieces), whole);
    }
}
