//! Bytes and the events they decode to, in one piece and in two.

use super::*;

/// Feeds each piece at its time, in milliseconds after the start, and then lets all timeouts pass;
/// returns abbreviated events.
pub(super) fn decode(pieces: &[(u64, &[u8])]) -> Vec<String> {
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
    events
}

fn short(event: &Event) -> String {
    match event {
        Event::Key(key) if key.modifiers.is_empty() => format!("{:?}", key.code),
        Event::Key(key) => {
            let names: Vec<_> = key.modifiers.iter_names().map(|(name, _)| name).collect();
            format!("{}+{:?}", names.join("+"), key.code)
        }
        Event::Mouse(mouse) => format!("{:?} {},{}", mouse.kind, mouse.column, mouse.row),
        other => format!("{other:?}"),
    }
}

#[test]
fn whole_sequences() {
    for (bytes, events) in [
        (&b"a"[..], &["Char('a')"][..]),
        (b"A", &["SHIFT+Char('A')"]),
        (b"\x1b[0n\x1b[3n", &["Reply(Status)", "Reply(Status)"]),
        (b"\r\t\x7f\x08", &["Enter", "Tab", "Backspace", "Backspace"]),
        (
            b"\x03\x0c\x00\x1c",
            &[
                "CONTROL+Char('c')",
                "CONTROL+Char('l')",
                "CONTROL+Char(' ')",
                "CONTROL+Char('\\\\')",
            ],
        ),
        ("é€𝄞".as_bytes(), &["Char('é')", "Char('€')", "Char('𝄞')"]),
        (
            b"\x1b[A\x1bOB\x1b[H\x1b[4~\x1b[5~\x1b[6~",
            &["Up", "Down", "Home", "End", "PageUp", "PageDown"],
        ),
        (
            b"\x1b[1;5C\x1b[3;2~\x1b[Z",
            &["CONTROL+Right", "SHIFT+Delete", "SHIFT+BackTab"],
        ),
        (
            b"\x1bOP\x1b[15~\x1b[24~\x1b[[E",
            &["F(1)", "F(5)", "F(12)", "F(5)"],
        ),
        (b"\x1bx\x1b\x7f", &["ALT+Char('x')", "ALT+Backspace"]),
        (
            b"\x1b[<0;1;2M\x1b[<0;3;4m",
            &["Down(Left) 0,1", "Up(Left) 2,3"],
        ),
        (
            b"\x1b[<34;9;9M\x1b[<65;1;1M",
            &["Drag(Right) 8,8", "ScrollDown 0,0"],
        ),
        (b"\x1b[<35;9;9M\x1b[M !!x", &["Char('x')"]),
        (
            b"\x1b[?62;4cx\x1b[12;40Ry\x1b[Iz",
            &[
                "Reply(AttributesWithSixel)",
                "Char('x')",
                "Char('y')",
                "Char('z')",
            ],
        ),
        (
            b"\x1b[200~a\rb\x1b[201~c",
            &["Paste(\"a\\nb\")", "Char('c')"],
        ),
        (b"\xff\xc3(", &["Char('(')"]),
        (b"\x1b\x1b", &["Esc", "Esc"]),
        (b"\x1b[12\x1b[A", &["Up"]),
    ] {
        assert_eq!(decode(&[(0, bytes)]), events, "{}", bytes.escape_ascii());
    }
}

#[test]
fn a_sequence_may_be_split_at_any_byte() {
    for sequence in [
        &b"\x1b[A"[..],
        b"\x1bOA",
        b"\x1b[5~",
        b"\x1b[1;2D",
        b"\x1b[[B",
        b"\x1b[<0;10;20M",
        b"\x1b[M !!",
        b"\x1b[200~paste\x1b[201~",
        "𝄞".as_bytes(),
    ] {
        let whole = decode(&[(0, sequence)]);
        for split in 1..sequence.len() {
            let (head, tail) = sequence.split_at(split);
            let halves = decode(&[(0, head), (20, tail)]);
            assert_eq!(halves, whole, "{} at {split}", sequence.escape_ascii());
        }
    }
}

#[test]
fn a_lone_escape_becomes_a_key_after_a_timeout() {
    assert_eq!(decode(&[(0, b"\x1b")]), ["Esc"]);
    assert_eq!(decode(&[(0, b"\x1b"), (24, b"[A")]), ["Up"]);
    assert_eq!(
        decode(&[(0, b"\x1b"), (25, b"[A")]),
        ["Esc", "Char('[')", "SHIFT+Char('A')"]
    );
    assert_eq!(decode(&[(0, b"\x1b[")]), ["ALT+Char('[')"]);
}

#[test]
fn a_paste_without_an_end_is_emitted_after_a_timeout() {
    assert_eq!(
        decode(&[(0, b"\x1b[200~a"), (9_999, b"b")]),
        ["Paste(\"ab\")"]
    );
}

#[test]
fn a_paste_ends_with_its_mark_and_is_not_kept_if_it_is_too_long() {
    for (inside, event) in [
        (&b""[..], "Paste(\"\")"),
        (b"\x1b[201x\x1b[20", "Paste(\"\\u{1b}[201x\\u{1b}[20\")"),
        (
            b"\x1b]11;\x07\x9d\xe2\x9c\xb3",
            "Paste(\"\\u{1b}]11;\\u{7}\u{fffd}\u{2733}\")",
        ),
        (&vec![b'a'; LONGEST_PASTE + 1], "LongPaste"),
        (&vec![b'a'; 3 * LONGEST_PASTE], "LongPaste"),
    ] {
        let bytes = [b"\x1b[200~", inside, b"\x1b[201~x"].concat();
        assert_eq!(decode(&[(0, &bytes)]), [event, "Char('x')"]);
        let (head, tail) = bytes.split_at(bytes.len() - 3);
        assert_eq!(decode(&[(0, head), (999, tail)]), [event, "Char('x')"]);
    }
    let longest = [b"\x1b[200~", &vec![b'a'; LONGEST_PASTE][..], b"\x1b[201~"].concat();
    assert!(decode(&[(0, &longest)])[0].starts_with("Paste"));
}

#[test]
fn endless_sequences_are_dropped_with_their_last_byte() {
    for length in [63, 64, 65, 80, 5000] {
        let noise = [&b"\x1b["[..], &vec![b'1'; length]].concat();
        assert_eq!(decode(&[(0, &noise), (1, b"q"), (1, b"x")]), ["Char('x')"]);
        assert_eq!(decode(&[(0, &noise), (1999, b"qx")]), ["Char('x')"]);
        assert_eq!(decode(&[(0, &noise), (2000, b"x")]), ["Char('x')"]);
        let noise = [&noise[..], b"qx"].concat();
        for each in 1..length.min(80) {
            let pieces: Vec<_> = noise.chunks(each).map(|piece| (0, piece)).collect();
            assert_eq!(decode(&pieces), ["Char('x')"], "by {each}");
        }
    }
}

#[test]
fn answers_are_not_keys() {
    let colour = "Reply(TrueColour)";
    for (pieces, events) in [
        (
            &[(0, &b"a\x1bP1$r0;38:2::49:73:87m\x1b\\b"[..])][..],
            &["Char('a')", colour, "Char('b')"][..],
        ),
        (&[(0, b"\x1bP1+r524742=38\x1b\\")], &[colour]),
        (&[(0, b"\x1bP0+r5463\x1b\\x")], &["Char('x')"]),
        (&[(0, b"\x1bP0$r\x1b\\")], &[]),
        // Slow answers, in several pieces.
        (&[(0, b"\x1bP"), (500, b"1+r5463\x1b\\")], &[colour]),
        (
            &[(0, b"\x1bP1+r54"), (500, b"63\x1b"), (900, b"\\")],
            &[colour],
        ),
        // About pictures.
        (
            &[
                (0, b"\x1b_Gi=31;"),
                (500, b"OK\x1b\\\x1b[6;20;9t\x1b[?62cx"),
            ],
            &[
                "Reply(Shows(Kitty))",
                "Reply(CellSize { width: 9, height: 20 })",
                "Reply(Attributes)",
                "Char('x')",
            ],
        ),
        (&[(0, b"\x1b_Gi=31;ENOENT\x1b\\x")], &["Char('x')"]),
        // Malformed answers, and one that never ends.
        (&[(0, b"\x1bP1$r\x1b[A")], &["Up"]),
        (&[(0, b"\x1bP1$rquit:q!\rj")], &[]),
        (&[(0, b"\x1bP1$rquit"), (2000, b"k")], &["Char('k')"]),
        (
            &[(0, b"\x1b[?2026;2$y\x1b[?62;4c")],
            &[
                "Reply(Mode { number: 2026, state: 2 })",
                "Reply(AttributesWithSixel)",
            ],
        ),
        (
            &[(0, b"\x1b[?2026$y\x1b[?1;$y")],
            &["Reply(Mode { number: 1, state: 1 })"],
        ),
        (
            &[(0, b"\x1b[?0u\x1b[?5ux")],
            &["Reply(KeysApart)", "Reply(KeysApart)", "Char('x')"],
        ),
    ] {
        assert_eq!(decode(pieces), events, "{pieces:?}");
    }
}
