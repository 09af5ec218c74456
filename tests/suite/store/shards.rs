//! Shares of the tiles: `--shard`, `status` and `merge`.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::collections::BTreeMap;
use std::path::Path;

use crate::cli::program::squealmap;
use crate::store::resume::{COMPLETE, SWEEP, names, tiles, with};
use squealmap::store::shard::Shard;

fn parse(text: &str, variables: &[(&str, &str)]) -> Result<(usize, usize), String> {
    let variables: BTreeMap<&str, &str> = variables.iter().copied().collect();
    let found = Shard::parse(text, &|name| variables.get(name).map(|text| (*text).to_owned()));
    found.map(|shard| (shard.number, shard.of))
}

#[test]
fn shards_are_every_tile_once() {
    for (count, of) in [(10, 3), (2, 5), (1, 1), (12, 4), (1000, 4), (5000, 7)] {
        let mut all: Vec<usize> = (0..of).flat_map(|number| Shard { number, of }.tiles(count)).collect();
        all.sort_unstable();
        assert_eq!(all, (0..count).collect::<Vec<_>>());
    }
    assert_eq!(Shard { number: 1, of: 3 }.tiles(10).collect::<Vec<_>>(), [1, 4, 7]);
    // Of many tiles those of a share follow one another, as a GPU computes them together.
    let tiles: Vec<usize> = Shard { number: 1, of: 4 }.tiles(1000).collect();
    assert_eq!(tiles[..17], [(16..32).collect::<Vec<_>>(), vec![80]].concat());
    assert!((240..=256).contains(&tiles.len()), "{}", tiles.len());
}

#[test]
fn shards_come_from_the_command_line_or_the_launcher() {
    assert_eq!(parse("2/8", &[]), Ok((2, 8)));
    let array = [
        ("SLURM_ARRAY_TASK_ID", "11"),
        ("SLURM_ARRAY_TASK_MIN", "5"),
        ("SLURM_ARRAY_TASK_STEP", "2"),
        ("SLURM_ARRAY_TASK_COUNT", "4"),
        ("SLURM_PROCID", "0"),
        ("SLURM_NTASKS", "1"),
    ];
    assert_eq!(parse("auto", &array), Ok((3, 4)));
    assert_eq!(parse("auto", &array[4..]), Ok((0, 1)));
    assert_eq!(parse("auto", &[("OMPI_COMM_WORLD_RANK", "3"), ("OMPI_COMM_WORLD_SIZE", "4")]), Ok((3, 4)));
    for name in ["JOB_COMPLETION_INDEX", "PBS_ARRAY_INDEX", "HQ_TASK_ID"] {
        assert_eq!(parse("auto/4", &[(name, "3")]), Ok((3, 4)));
        // Numbers from 1 on.
        assert_eq!(parse("auto/4", &[(name, "4")]), Ok((0, 4)));
        assert_eq!(
            parse("auto", &[(name, "3")]),
            Err(format!("{name} does not say of how many; write auto/n"))
        );
    }
    for (text, part) in [
        ("4/4", "shard 4 of 4 does not exist"),
        ("0/0", "does not exist"),
        ("1", "write k/n"),
        ("a/b", "write k/n"),
        ("auto/0", "write k/n"),
        ("auto", "none of SLURM_ARRAY_TASK_ID"),
    ] {
        assert!(parse(text, &[]).unwrap_err().contains(part), "{text}");
    }
    let outside = [("OMPI_COMM_WORLD_RANK", "4"), ("OMPI_COMM_WORLD_SIZE", "4")];
    assert!(parse("auto", &outside).unwrap_err().contains("OMPI_COMM_WORLD_RANK is 4"));
}

/// Runs shard `shard` of the sweep into `output`.
fn shard(directory: &Path, shard: &str, output: &str) -> crate::cli::program::Ended {
    squealmap(
        directory,
        &["run", "s.toml", "--backend", "cpu", "--tile", "32", "--shard", shard, "-o", output],
    )
}

#[test]
fn shards_of_one_directory_and_of_several_make_the_whole() {
    let whole = with(SWEEP);
    squealmap(whole.path(), &["run", "s.toml", "--backend", "cpu", "--tile", "32"]);
    let csv = std::fs::read(whole.path().join("out/s/map.csv")).unwrap();

    let directory = with(SWEEP);
    let ended = shard(directory.path(), "0/2", "out/s");
    assert!(ended.code == Some(0) && ended.out.contains("; 5 of 10 tiles are in out/s\n"), "{}", ended.out);
    assert_eq!(names(directory.path()), ["source.txt", "sweep.json", "tiles"], "a shard writes no results");
    let status = squealmap(directory.path(), &["status", "out/s"]);
    for line in [
        "title      Tiles\n",
        "tiles      5 of 10 done, 0 in work, 0 bad, 0 set aside\n",
        "instances  160 of 300 done, 53.3 %\n",
    ] {
        assert!(status.out.contains(line), "{line}{}", status.out);
    }
    let ended = squealmap(directory.path(), &["merge", "out/s"]);
    assert_eq!((ended.code, ended.out.as_str()), (Some(1), "0 tiles brought, 5 of 10 are there\n"));

    let ended = shard(directory.path(), "1/2", "elsewhere");
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let ended = squealmap(directory.path(), &["merge", "out/s", "elsewhere"]);
    assert!(ended.out.starts_with("5 tiles brought, 10 of 10 are there\n"), "{}{}", ended.out, ended.err);
    assert!(tiles(directory.path()) == tiles(whole.path()));
    assert_eq!(names(directory.path()), COMPLETE);
    assert!(std::fs::read(directory.path().join("out/s/map.csv")).unwrap() == csv);
    // Once more changes nothing.
    let ended = squealmap(directory.path(), &["merge", "out/s", "elsewhere"]);
    assert_eq!(ended.out, "0 tiles brought, 10 of 10 are there; the results are those of all of them\n");
    // Into a directory that does not exist yet.
    let ended = squealmap(directory.path(), &["merge", "new", "elsewhere", "out/s"]);
    assert!(ended.out.starts_with("10 tiles brought, 10 of 10 are there\n"), "{}{}", ended.out, ended.err);
    assert!(std::fs::read(directory.path().join("new/map.csv")).unwrap() == csv);
}

#[test]
fn what_can_not_be_merged_is_named() {
    let directory = with(SWEEP);
    shard(directory.path(), "0/2", "one");
    std::fs::write(directory.path().join("s.toml"), SWEEP.replace("mu_s = 0.4", "mu_s = 0.5")).unwrap();
    shard(directory.path(), "1/2", "two");
    let ended = squealmap(directory.path(), &["merge", "one", "two"]);
    assert_eq!(ended.code, Some(2));
    assert_eq!(
        ended.err,
        "error: `one` and `two` hold tiles of different sweeps, program versions or engines; merge those of one\n"
    );
    let ended = squealmap(directory.path(), &["status", "three"]);
    assert_eq!(ended.code, Some(2));
    assert_eq!(
        ended.err,
        "error: `three` holds no tiles; name the output directory of a `squealmap run` of a whole grid\n"
    );
}

#[test]
fn status_names_bad_tiles() {
    let directory = with(SWEEP);
    shard(directory.path(), "0/1", "out/s");
    let names: Vec<_> = tiles(directory.path()).into_iter().collect();
    let path = |number: usize| directory.path().join("out/s/tiles").join(&names[number].0);
    std::fs::write(path(2), b"").unwrap();
    let mut flipped = names[4].1.clone();
    flipped[1000] ^= 1;
    std::fs::write(path(4), flipped).unwrap();
    let quick = squealmap(directory.path(), &["status", "out/s"]).out;
    assert!(quick.contains("tiles      9 of 10 done, 0 in work, 1 bad, 0 set aside\n"), "{quick}");
    let thorough = squealmap(directory.path(), &["status", "out/s", "--verify"]).out;
    assert!(thorough.contains("tiles      8 of 10 done, 0 in work, 2 bad, 0 set aside\n"), "{thorough}");
    let sentence = format!(
        "bad        `out/s/tiles/{}`: its checksum does not match its content; the next run computes it again\n",
        names[4].0.display()
    );
    assert!(thorough.contains(&sentence), "{thorough}");
    let ended = squealmap(directory.path(), &["merge", "out/s"]);
    assert_eq!((ended.code, ended.out.as_str()), (Some(1), "0 tiles brought, 8 of 10 are there\n"));
    let status = squealmap(directory.path(), &["status", "out/s"]).out;
    assert!(status.contains("tiles      8 of 10 done, 0 in work, 0 bad, 2 set aside\n"), "{status}");
}
