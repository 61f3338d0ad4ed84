//! A pseudo-terminal, and starting a program on it.
#![allow(
    unsafe_code,
    reason = "what a child does before it runs a program can only be set so"
)]

use std::ffi::CString;
use std::fs::File;
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, Stdio};

use rustix::fs::{Mode, OFlags};
use rustix::io::FdFlags;
use rustix::process::{Pid, ioctl_tiocsctty, setsid};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{Termios, Winsize, tcgetattr, tcgetpgrp, tcsetwinsize};
use signal_hook::consts::{SIGALRM, SIGCHLD, SIGHUP, SIGINT, SIGQUIT, SIGTERM};
use signal_hook::low_level::register;

/// The signals that a program finds with their default actions, whatever this process ignores.
const SIGNALS: [i32; 6] = [SIGALRM, SIGCHLD, SIGHUP, SIGINT, SIGQUIT, SIGTERM];

/// The side of a pseudo-terminal on which its user types and reads. The terminal is hung up once
/// this and all of its clones are closed.
pub(crate) struct Terminal {
    user: File,
}

impl Terminal {
    /// Opens a terminal of this size, in cells; returns it with its other side, on which
    /// [`start`] runs a program.
    pub(crate) fn open(columns: u16, rows: u16) -> io::Result<(Self, OwnedFd)> {
        let flags = OpenptFlags::RDWR | OpenptFlags::NOCTTY;
        // Programs that other threads start meanwhile would keep the terminal open.
        #[cfg(target_os = "linux")]
        let flags = flags | OpenptFlags::CLOEXEC;
        let user = openpt(flags)?;
        rustix::io::fcntl_setfd(&user, FdFlags::CLOEXEC)?;
        grantpt(&user)?;
        unlockpt(&user)?;
        let terminal = Self { user: user.into() };
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::CLOEXEC;
        let line = rustix::fs::open(terminal.name()?, flags, Mode::empty())?;
        terminal.resize(columns, rows)?;
        Ok((terminal, line))
    }

    /// Another handle, to read what programs write and to write what is typed. Reading fails once no
    /// program has the terminal open.
    pub(crate) fn handle(&self) -> io::Result<File> {
        self.user.try_clone()
    }

    /// Changes the size, in cells.
    pub(crate) fn resize(&self, columns: u16, rows: u16) -> io::Result<()> {
        let size = Winsize {
            ws_row: rows,
            ws_col: columns,
            ws_xpixel: 0,
            ws_ypixel: 0,
        };
        Ok(tcsetwinsize(&self.user, size)?)
    }

    /// The settings that programs change.
    pub(crate) fn settings(&self) -> io::Result<Termios> {
        Ok(tcgetattr(&self.user)?)
    }

    /// The leader of the foreground process group.
    pub(crate) fn process_in_front(&self) -> io::Result<Pid> {
        Ok(tcgetpgrp(&self.user)?)
    }

    /// The path of the side for programs.
    pub(crate) fn name(&self) -> io::Result<CString> {
        Ok(ptsname(&self.user, Vec::new())?)
    }
}

/// Starts a command that reads from a terminal's line and writes to it, as the leader of a session
/// that the terminal controls.
pub(crate) fn start(mut command: Command, line: OwnedFd) -> io::Result<Child> {
    command.stdin(line.try_clone()?);
    command.stdout(line.try_clone()?);
    command.stderr(Stdio::from(line));
    let lead = || {
        for signal in SIGNALS {
            // Signals with handlers have their default actions in the next program.
            // SAFETY: the handler does nothing.
            unsafe { register(signal, || {}) }?;
        }
        setsid()?;
        Ok(ioctl_tiocsctty(rustix::stdio::stdin())?)
    };
    // SAFETY: only this thread is in the child. It waits for no lock that another thread may have
    // held: the allocator's is free after a fork, and nothing else here registers handlers.
    unsafe { command.pre_exec(lead) };
    command.spawn()
}
