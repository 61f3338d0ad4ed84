//! A repository all of whose settings that name programs do so: no program is run.

use std::collections::BTreeSet;
use std::os::unix::fs::{PermissionsExt, symlink};

use super::super::git::GUARDS;
use super::*;

/// The settings that name programs, as names with values, which are `PROGRAM` unless they are given:
/// one that leaves a trace. Those of remotes are in [`REMOTES`].
const SETTINGS: &str = "
    alias.cat-file=!PROGRAM alias.ls-tree=!PROGRAM browser.x.cmd core.alternateRefsCommand
    core.askPass core.attributesFile=ATTRIBUTES core.editor core.fsmonitor core.gitProxy
    core.hooksPath=HOOKS core.pager core.sshCommand credential.helper=!PROGRAM diff.external
    diff.x.command diff.x.textconv difftool.x.cmd fetch.bundleURI=BUNDLE filter.x.clean
    filter.x.process filter.x.required=true filter.x.smudge gc.auto=1 gpg.program
    gpg.ssh.defaultKeyCommand gpg.ssh.program guitool.x.cmd hook.x.command
    hook.x.event=post-index-change imap.tunnel include.path=INCLUDED
    includeIf.gitdir:**.path=INCLUDED interactive.diffFilter log.showSignature=true man.x.cmd
    merge.x.driver mergetool.x.cmd pager.cat-file pager.ls-tree protocol.allow=always
    protocol.ext.allow=always sendemail.sendmailCmd sequence.editor ssh.variant=simple
    submodule.x.update=!PROGRAM tar.x.command trailer.x.cmd uploadpack.packObjectsHook
";

/// The ways to fetch a missing object, each of which runs a program.
const REMOTES: [&str; 6] = [
    "remote.origin.url=/nowhere remote.origin.uploadpack",
    "remote.origin.url=ssh://h/x",
    "remote.origin.url=git://h/x",
    "remote.origin.url=ext::PROGRAM",
    "remote.origin.url remote.origin.vcs=ext",
    "remote.origin.url=x:y url.ext::PROGRAM.insteadOf=x:y",
];

const HOOKS: &str = "fsmonitor-watchman post-checkout post-index-change pre-auto-gc proc-receive \
    reference-transaction";

/// What the repository lacks.
const LACKING: [Option<&str>; 4] = [
    None,
    Some("HEAD:scenes/a.ray"),
    Some("HEAD:scenes"),
    Some("HEAD"),
];

struct Planted {
    folder: TempDir,
    scene: PathBuf,
}

impl Planted {
    /// A repository with a scene, which would fetch missing objects from a remote.
    fn new(remote: &str) -> Option<Self> {
        let folder = repository()?;
        let at = |name: &str| folder.path().join(name);
        for name in ["scenes", "traces", "hooks"] {
            fs::create_dir(at(name)).expect("the folder is new");
        }
        fs::write(at(".gitignore"), "/*\n!/scenes\n").expect("the folder is new");
        let scene = at("scenes/a.ray");
        fs::write(&scene, "one").expect("the folder is new");
        commit(folder.path());
        let attributes = "* filter=x diff=x merge=x\n";
        for name in ["attributes", ".git/info/attributes"] {
            fs::write(at(name), attributes).expect("the folder is new");
        }
        let planted = Self { folder, scene };
        let bundle = planted.at("bundle").display().to_string();
        let create = ["bundle", "create", "-q", &bundle, "--all"];
        git(planted.folder.path(), &create);
        for hook in HOOKS.split(' ') {
            let program = planted.program(hook);
            for folder in ["hooks", ".git/hooks"] {
                symlink(&program, planted.at(&format!("{folder}/{hook}"))).expect("it is new");
            }
        }
        let included = planted.lines("core.sshCommand core.fsmonitor");
        fs::write(planted.at("included"), included).expect("it is new");
        let fetching = "core.repositoryformatversion=1 extensions.partialClone=origin \
            remote.origin.promisor=true";
        let lines = [SETTINGS, fetching, remote].map(|settings| planted.lines(settings));
        fs::write(planted.at(".git/config"), lines.concat()).expect("writable");
        Some(planted)
    }

    fn at(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A program that leaves a trace with a name.
    fn program(&self, name: &str) -> PathBuf {
        let place = self.at(&format!("run-{}", name.replace([':', '*', '/'], "_")));
        let trace = self.at("traces").join(place.file_name().expect("a name"));
        let script = format!("#!/bin/sh\n: > '{}'\nexit 1\n", trace.display());
        fs::write(&place, script).expect("writable");
        fs::set_permissions(&place, fs::Permissions::from_mode(0o700)).expect("it is ours");
        place
    }

    /// Settings as lines of a configuration.
    fn lines(&self, settings: &str) -> String {
        let line = |setting: &str| {
            let (name, value) = setting.split_once('=').unwrap_or((setting, "PROGRAM"));
            let program = self.program(name).display().to_string();
            let (section, key) = name.rsplit_once('.').expect("a section");
            let head = match section.split_once('.') {
                Some((section, part)) => format!("{section} \"{part}\""),
                None => section.to_owned(),
            };
            let mut value = value.replace("PROGRAM", &program);
            for word in ["ATTRIBUTES", "BUNDLE", "HOOKS", "INCLUDED"] {
                let place = self.at(&word.to_lowercase()).display().to_string();
                value = value.replace(word, &place);
            }
            let head = head.replace("PROGRAM", &program);
            format!("[{head}]\n{key} = \"{value}\"\n")
        };
        settings.split_whitespace().map(line).collect()
    }

    /// The file of an object.
    fn object(&self, name: &str) -> PathBuf {
        let id = git(self.folder.path(), &["rev-parse", name]).expect("git is there");
        self.at(".git/objects").join(&id[..2]).join(&id[2..])
    }

    /// The names of the programs that were run.
    fn traces(&self) -> Vec<String> {
        let entries = fs::read_dir(self.at("traces")).expect("a folder");
        let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").file_name();
        entries
            .map(|entry| name(entry).to_string_lossy().into_owned())
            .collect()
    }
}

/// Every git on the path.
fn gits() -> BTreeSet<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let programs = std::env::split_paths(&path).map(|folder| folder.join("git"));
    programs
        .filter_map(|git| fs::canonicalize(git).ok())
        .collect()
}

/// The guards that a git knows, and each of them alone.
fn guards(program: &Path) -> Vec<&'static [(&'static str, &'static str)]> {
    let version = Command::new(program).arg("version").output();
    let version = String::from_utf8_lossy(&version.expect("it runs").stdout).into_owned();
    let words = version.split([' ', '.']);
    let mut numbers = words.filter_map(|word| word.parse().ok());
    let version: [Option<u32>; 2] = [numbers.next(), numbers.next()];
    let (lazy, protocol) = GUARDS.split_at(1);
    if [Some(2), Some(45)] <= version {
        vec![&GUARDS, lazy, protocol]
    } else {
        vec![&GUARDS, protocol]
    }
}

#[test]
fn a_repository_runs_no_program() {
    for remote in REMOTES {
        let Some(planted) = Planted::new(remote) else {
            return;
        };
        for lacking in LACKING {
            let away = lacking.map(|name| (planted.object(name), planted.at("away")));
            if let Some((object, away)) = &away {
                fs::rename(object, away).expect("a loose object");
            }
            for program in gits() {
                for guards in guards(&program) {
                    let folder = planted.scene.parent().expect("a folder");
                    let git = Git::of_folder(folder).with(&program, guards);
                    let read = text_by(&git, "HEAD", &planted.scene, |_| Ok(()));
                    let case = format!("{program:?} {guards:?} {remote:?} {lacking:?}: {read:?}");
                    assert_eq!(planted.traces(), [] as [String; 0], "{case}");
                    match (lacking, read) {
                        (None, read) => assert_eq!(read, Ok("one".to_owned()), "{case}"),
                        (Some(_), Ok(_)) => panic!("{case}"),
                        (Some(_), Err(reason)) => {
                            assert!(reason.contains("missing from the repository"), "{case}");
                        }
                    }
                }
            }
            if let Some((object, away)) = &away {
                fs::rename(away, object).expect("it was there");
            }
        }
    }
}

/// Without guards each remote runs its program, so that the test above has something to find.
#[test]
fn each_remote_would_run_a_program() {
    for remote in REMOTES {
        let Some(planted) = Planted::new(remote) else {
            return;
        };
        fs::remove_file(planted.object("HEAD:scenes/a.ray")).expect("a loose object");
        for program in gits() {
            let folder = planted.scene.parent().expect("a folder");
            let git = Git::of_folder(folder).with(&program, &[]);
            let read = text_by(&git, "HEAD", &planted.scene, |_| Ok(()));
            let traces = planted.traces();
            assert!(!traces.is_empty(), "{program:?} {remote:?}: {read:?}");
            for trace in traces {
                fs::remove_file(planted.at("traces").join(trace)).expect("it is there");
            }
        }
    }
}
