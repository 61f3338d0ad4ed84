//! Bytes and the events they decode to, in one piece and in two.

mod answers;

use super::*;

/// Feeds each piece at its time, in milliseconds after the start, and then lets all timeouts pass;
/// returns abbreviated events with spaces between them.
fn decode(pieces: &[(u64, &[u8])]) -> String {
    let start = Instant::now();
    let mut decoder = Decoder::default();
    let mut events = Vec::new();
    for &(after, bytes) in pieces {
        let now = start + Duration::from_millis(after);
        decoder.expire(now, |event| events.push(short(&event)));
        decoder.feed(bytes, now, |event| events.push(short(&event)));
    }
    decoder.expire(start + Duration::from_hours(1), |event| {
        events.push(short(&event));
    });
    assert_eq!(decoder.deadline(), None, "everything is decoded in the end");
    events.join(" ")
}

fn short(event: &Event) -> String {
    match event {
        Event::Key(key) => {
            let names = key.modifiers.iter_names().map(|(name, _)| name.to_owned());
            let code = match key.code {
                KeyCode::Char(character) => format!("{character:?}"),
                code => format!("{code:?}"),
            };
            names.chain([code]).collect::<Vec<_>>().join("+")
        }
        Event::Mouse(mouse) => format!("{:?} {},{}", mouse.kind, mouse.column, mouse.row),
        other => format!("{other:?}"),
    }
}

#[test]
fn whole_sequences() {
    for (bytes, events) in table! {
        &b"a"[..] => "'a'";
        b"A" => "SHIFT+'A'";
        b"\x1b[0n\x1b[3n" => "Reply(Status) Reply(Status)";
        b"\r\t\x7f\x08" => "Enter Tab Backspace Backspace";
        b"\x03\x0c\x00\x1c" => r"CONTROL+'c' CONTROL+'l' CONTROL+' ' CONTROL+'\\'";
        "é€𝄞".as_bytes() => "'é' '€' '𝄞'";
        b"\x1b[A\x1bOB\x1b[H\x1b[4~\x1b[5~\x1b[6~" => "Up Down Home End PageUp PageDown";
        b"\x1b[1;5C\x1b[3;2~\x1b[Z" => "CONTROL+Right SHIFT+Delete SHIFT+BackTab";
        b"\x1bOP\x1b[15~\x1b[24~\x1b[[E" => "F(1) F(5) F(12) F(5)";
        b"\x1bx\x1b\x7f" => "ALT+'x' ALT+Backspace";
        b"\x1b[<0;1;2M\x1b[<0;3;4m" => "Down(Left) 0,1 Up(Left) 2,3";
        b"\x1b[<34;9;9M\x1b[<65;1;1M" => "Drag(Right) 8,8 ScrollDown 0,0";
        b"\x1b[<35;9;9M\x1b[M !!x" => "'x'";
        b"\x1b[?62;4cx\x1b[12;40Ry\x1b[Iz" => "Reply(AttributesWithSixel) 'x' 'y' 'z'";
        b"\x1b[200~a\rb\x1b[201~c" => r#"Paste("a\nb") 'c'"#;
        b"\xff\xc3(" => "'('";
        b"\x1b\x1b" => "Esc Esc";
        b"\x1b[12\x1b[A" => "Up";
    } {
        let decoded = decode(&[(0, bytes)]);
        assert_eq!(decoded, events, "{}", bytes.escape_ascii());
    }
}

#[test]
fn a_sequence_may_be_split_at_any_byte() {
    let apart = "\x1b[A \x1bOA \x1b[5~ \x1b[1;2D \x1b[[B \x1b[<0;10;20M \x1b[200~paste\x1b[201~ 𝄞";
    for sequence in apart.split(' ').chain(["\x1b[M !!"]).map(str::as_bytes) {
        let whole = decode(&[(0, sequence)]);
        for split in 1..sequence.len() {
            let (head, tail) = sequence.split_at(split);
            let halves = decode(&[(0, head), (20, tail)]);
            assert_eq!(halves, whole, "{} at {split}", sequence.escape_ascii());
        }
    }
}

#[test]
fn time_decides_what_an_escape_or_a_paste_is() {
    for (pieces, events) in table! {
        &[(0, &b"\x1b"[..])][..] => "Esc";
        &[(0, b"\x1b"), (24, b"[A")] => "Up";
        &[(0, b"\x1b"), (25, b"[A")] => "Esc '[' SHIFT+'A'";
        &[(0, b"\x1b[")] => "ALT+'['";
        // A paste without an end.
        &[(0, b"\x1b[200~a"), (9_999, b"b")] => r#"Paste("ab")"#;
    } {
        assert_eq!(decode(pieces), events, "{pieces:?}");
    }
}

#[test]
fn a_paste_ends_with_its_mark_and_is_not_kept_if_it_is_too_long() {
    for (inside, event) in table! {
        &b""[..] => r#"Paste("")"#;
        b"\x1b[201x\x1b[20" => r#"Paste("\u{1b}[201x\u{1b}[20")"#;
        b"\x1b]11;\x07\x9d\xe2\x9c\xb3" => "Paste(\"\\u{1b}]11;\\u{7}\u{fffd}\u{2733}\")";
        &vec![b'a'; LONGEST_PASTE + 1] => "LongPaste";
        &vec![b'a'; 3 * LONGEST_PASTE] => "LongPaste";
    } {
        let bytes = [b"\x1b[200~", inside, b"\x1b[201~x"].concat();
        let (head, tail) = bytes.split_at(bytes.len() - 3);
        for pieces in [&[(0, &bytes[..])][..], &[(0, head), (999, tail)]] {
            assert_eq!(decode(pieces), format!("{event} 'x'"));
        }
    }
    let longest = [b"\x1b[200~", &vec![b'a'; LONGEST_PASTE][..], b"\x1b[201~"].concat();
    assert!(decode(&[(0, &longest)]).starts_with("Paste"));
}

#[test]
fn endless_sequences_are_dropped_with_their_last_byte() {
    for length in [63, 64, 65, 80, 5000] {
        let noise = [&b"\x1b["[..], &vec![b'1'; length]].concat();
        let rest: [&[(u64, &[u8])]; 3] =
            [&[(1, b"q"), (1, b"x")], &[(1999, b"qx")], &[(2000, b"x")]];
        for rest in rest {
            assert_eq!(decode(&[&[(0, &noise[..])], rest].concat()), "'x'");
        }
        let noise = [&noise[..], b"qx"].concat();
        for each in 1..length.min(80) {
            let pieces: Vec<_> = noise.chunks(each).map(|piece| (0, piece)).collect();
            assert_eq!(decode(&pieces), "'x'", "by {each}");
        }
    }
}

#[test]
fn answers_are_not_keys() {
    let colour = "Reply(TrueColour)";
    for (pieces, events) in table! {
        &[(0, &b"a\x1bP1$r0;38:2::49:73:87m\x1b\\b"[..])][..] => "'a' Reply(TrueColour) 'b'";
        &[(0, b"\x1bP1+r524742=38\x1b\\")] => colour;
        &[(0, b"\x1bP0+r5463\x1b\\x")] => "'x'";
        &[(0, b"\x1bP0$r\x1b\\")] => "";
        // Slow answers, in several pieces.
        &[(0, b"\x1bP"), (500, b"1+r5463\x1b\\")] => colour;
        &[(0, b"\x1bP1+r54"), (500, b"63\x1b"), (900, b"\\")] => colour;
        // About pictures.
        &[(0, b"\x1b_Gi=31;"), (500, b"OK\x1b\\\x1b[6;20;9t\x1b[?62cx")] =>
            "Reply(Shows(Kitty)) Reply(CellSize { width: 9, height: 20 }) Reply(Attributes) 'x'";
        &[(0, b"\x1b_Gi=31;ENOENT\x1b\\x")] => "'x'";
        // Malformed answers, and one that never ends.
        &[(0, b"\x1bP1$r\x1b[A")] => "Up";
        &[(0, b"\x1bP1$rquit:q!\rj")] => "";
        &[(0, b"\x1bP1$rquit"), (2000, b"k")] => "'k'";
        &[(0, b"\x1b[?2026;2$y\x1b[?62;4c")] =>
            "Reply(Mode { number: 2026, state: 2 }) Reply(AttributesWithSixel)";
        &[(0, b"\x1b[?2026$y\x1b[?1;$y")] => "Reply(Mode { number: 1, state: 1 })";
        &[(0, b"\x1b[?0u\x1b[?5ux")] => "Reply(KeysApart) Reply(KeysApart) 'x'";
    } {
        assert_eq!(decode(pieces), events, "{pieces:?}");
    }
}
