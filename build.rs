//! Hands the git commit of the checkout to the crate as `SQUEALMAP_COMMIT`; unset outside a checkout. Puts the page of the
//! explorer into the program, where `crates/explorer/build` has made one.

use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let root = std::env::var("CARGO_MANIFEST_DIR").unwrap_or_default();
    page(&root);
    // A crate unpacked inside somebody else's repository must not report that repository's commit.
    let Some(top) = git(&root, &["rev-parse", "--show-toplevel"]) else { return };
    let same = match (Path::new(&top).canonicalize(), Path::new(&root).canonicalize()) {
        (Ok(top), Ok(root)) => top == root,
        _ => false,
    };
    if !same {
        return;
    }
    // A commit writes the log of HEAD; HEAD itself only names the branch. A missing file would always rerun.
    for file in ["HEAD", "index", "logs/HEAD"] {
        if let Some(path) =
            git(&root, &["rev-parse", "--git-path", file]).filter(|path| Path::new(path).exists())
        {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    // Everything that the binary is made of: a change of it is a change of the mark below.
    for made_of in ["src", "shaders", "crates/figure/fonts", "sweeps/paper", "Cargo.toml", "Cargo.lock"] {
        println!("cargo::rerun-if-changed={made_of}");
    }
    let Some(commit) = git(&root, &["rev-parse", "HEAD"]) else { return };
    let changes = git(&root, &["status", "--porcelain", "--untracked-files=no"]).unwrap_or_default();
    let mark = if changes.is_empty() { "" } else { "-dirty" };
    println!("cargo::rustc-env=SQUEALMAP_COMMIT={commit}{mark}");
}

/// Writes `page.rs`: the page of the explorer, or that there is none.
fn page(root: &str) {
    // The folder, as a missing file would always rerun.
    println!("cargo::rerun-if-changed=assets");
    let built = Path::new(root).join("assets/explore.html");
    let page = if built.is_file() {
        format!("Some(include_str!(r\"{}\"))", built.display())
    } else {
        "None".to_owned()
    };
    let text =
        format!("/// The page without a sweep, where one was built.\nconst PAGE: Option<&str> = {page};\n");
    let path = Path::new(&std::env::var("OUT_DIR").unwrap_or_default()).join("page.rs");
    if let Err(why) = std::fs::write(&path, text) {
        println!("cargo::error=`{}` cannot be written: {why}", path.display());
    }
}

/// The trimmed output of a git command, `None` when it fails or git is missing. None writes to the index, as `status` may: a file that
/// is newer than this run would run it again, and compile everything.
fn git(root: &str, arguments: &[&str]) -> Option<String> {
    let output =
        Command::new("git").arg("--no-optional-locks").current_dir(root).args(arguments).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
