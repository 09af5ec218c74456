"""What is refused is an exception with the very sentence of the program, and never the end of the interpreter."""

import json
import pathlib
import re
import subprocess
import sys
import textwrap

import pytest
import squealmap
from conftest import FIRST

HEAD = 'friction.mu_d = 0.2\nfriction.mu_s = 0.5\nbelt.belt_velocity = 3\n'

# Keys with values of a wrong type, or beyond their limits, each in its section.
WRONG = {
    "model": {
        "m1": ['"heavy"', "0", "-1", "nan", "inf", "[1]"],
        "m2": ["true", "0.0", "1979-05-27"],
        "k1": ["{}", "-5"],
        "k2": ['""', "-inf"],
        "c1": ["-0.1"],
        "c2": ["[[]]"],
        "f_ext": ["0", '"1 kN"'],
        "theta": ["1.6", "-2"],
        "restitution": ["1.1", "-0.1"],
        "impact_friction": ["1", '"yes"'],
        "kind": ['"three_mass"', "2"],
        "modes": ["7", '"nothing.toml"'],
        "mass": ["1"],
        "damping_ratio": ["0.1"],
    },
    "friction": {
        "law": ['"stribeck"', "3", "[]"],
        "mu_s": ["-0.1", '"0.4"', "nan"],
        "mu_d": ["-1e-9", "{a = 1}"],
        "knee_velocity": ["0", "-5"],
        "stribeck_velocity": ["0.5"],
        "decay": ["1"],
        "table": ['"none.csv"', "5"],
        "material": ['"none.csv"', "[1, 2]"],
        "outside": ['"ignore"', "true"],
        "temperature": ["100", '"hot"'],
        "knee": ["5"],
    },
    "belt": {
        "belt_velocity": ["-1", '"fast"', "inf"],
        "belt_velocity_end": ["3"],
        "ramp_duration": ["0", "2"],
        "velocity": ["3"],
    },
    "start": {
        "kind": ['"jump"', "1"],
        "box_samples": ["0", "1.5", "10000000"],
        "start_velocity": ["nan", '"0.01"'],
        "start_fraction": ["0.1"],
        "large_velocity": ["1"],
        "nothing": ["1"],
    },
    "response": {
        "settle": ['"soon"', "6", '"-1 s"', '"6 parsecs"'],
        "settle_limit": ['"1 s"', "true"],
        "measure": ['"0 s"', "[]"],
        "steps_per_period": ["2", "12.5", "1000000"],
        "check": ['"no"', "0"],
        "window": ["1"],
    },
    "axes": {
        "mu_s": ["5", "{ from = 0 }", "{ from = 0, to = 1, points = 0 }", "{ values = [] }", '{ values = ["a"] }'],
        "mu_d": ["{ from = 1, to = 0, points = 3, scale = \"log\" }", "{ from = 0.1, to = 0.5, points = 1 }"],
        "law": ["{ values = [\"none\"] }", "{ from = 0, to = 1, points = 2 }"],
        "speed": ["{ values = [1] }"],
        "theta": ["{ from = 0, to = 2, points = 3 }", "{ from = 0, to = 0.1, points = 3, step = 1 }"],
        "belt_velocity": ["{ from = 0, to = 1, points = 99999999999999 }", "{ from = nan, to = 1, points = 3 }"],
    },
}

TEXTS = [
    "axes = 5",
    "axes = []",
    "points = 3",
    'points = "none.csv"',
    "title = 5",
    'title = "a\\nb"',
    "analysis = []",
    'analysis = ["all"]',
    "analysis = 3",
    "refine = true",
    "refine.coarse = 1",
    "nonsense = 1",
    "a = ",
    "[model",
    "= 3",
    'x = "never ends',
    "model = 1\nmodel = 2",
    "\x00",
    '"\\ud800" = 1',
    "[[model]]",
]


def bad():
    for section, keys in WRONG.items():
        for key, values in keys.items():
            for value in values:
                yield f"{section}.{key} = {value}"
    yield from TEXTS


def text_of(line):
    """A sweep that is valid but for this line."""
    key = line.split(" = ")[0]
    head = "".join(one + "\n" for one in HEAD.splitlines() if one.split(" = ")[0] != key)
    return head + line + "\n"


CASES = sorted(set(bad()))


def test_there_are_a_hundred():
    assert len(CASES) >= 100


def test_the_sentence_of_the_program(tmp_path, program, monkeypatch):
    """Every bad file: refused by both, in the same words."""
    monkeypatch.chdir(tmp_path)
    refused = 0
    for number, line in enumerate(CASES):
        path = tmp_path / f"bad{number}.toml"
        path.write_text(text_of(line))
        ended = program("run", path.name, "--json", "-o", f"out{number}", cwd=tmp_path)
        said = json.loads(ended.stdout).get("error")
        if said is None:
            # A line that is no mistake after all is none for both.
            squealmap.run(path.name)
            continue
        refused += 1
        assert ended.returncode == 2, (line, said)
        with pytest.raises(squealmap.InputError) as raised:
            squealmap.run(path.name)
        assert str(raised.value) == said, line
    assert refused >= 100, refused


def test_a_dict_is_told_its_key():
    """The same sentence, with the key and its value as the place."""
    for line, rest in [
        ({"axes": {"mu_s": {"from": -0.1, "to": 0.6, "points": 8}}}, "`from` of axis `mu_s` is -0.1 but must be"),
        ({"friction": {"law": "coulomb"}}, "coulomb"),
        ({"axes": 5}, "must be"),
    ]:
        with pytest.raises(squealmap.InputError, match=re.escape(rest)) as raised:
            squealmap.run({**FIRST, **line})
        key = re.escape("axes") if "axes" in line else "friction"
        assert re.match(rf"{key}[a-z_.]* = ", str(raised.value)), str(raised.value)


WRONG_TYPES = [
    None, 5, 1.5, True, [], (), set(), b"first.toml", object(), print, squealmap, iter(()), complex(1, 2),
    {"axes": None}, {"axes": {"mu_s": None}}, {"axes": {"mu_s": {"from": object()}}}, {1: 2}, {None: 1}, {"a": {2: 3}},
    {"title": b"bytes"}, {"title": "\ud800"}, {"axes": {"mu_s": {"values": {1, 2}}}}, {"axes": {"mu_s": lambda: 0}},
    {"response": {"check": NotImplemented}}, {"model": {"m1": complex(1)}}, {"points": object()},
]


@pytest.mark.parametrize("number", range(len(WRONG_TYPES)))
@pytest.mark.parametrize("call", ["run", "linear", "modes", "trace"])
def test_wrong_types(number, call):
    with pytest.raises(TypeError):
        getattr(squealmap, call)(WRONG_TYPES[number])


def test_dicts_without_end():
    endless = {}
    endless["model"] = endless
    with pytest.raises(TypeError, match="deep"):
        squealmap.run(endless)
    within = []
    within.append(within)
    with pytest.raises(TypeError, match="deep"):
        squealmap.run({"axes": {"mu_s": {"values": within}}})


def test_numbers_without_end():
    for value in [10**5000, -(10**5000), 10**50]:
        with pytest.raises(squealmap.InputError):
            squealmap.run({**FIRST, "model": {"m1": value, "theta": value}})


def test_wrong_options():
    for keys, words in [
        ({"backend": "tpu"}, "backend is \"tpu\" but must be one of auto, gpu, cpu, reference"),
        ({"precision": "f16"}, "precision is"),
        ({"threads": 0}, "threads is 0 but must be"),
        ({"threads": 5000}, "threads is 5000"),
        ({"threads": "two"}, "threads is two"),
        ({"threads": -1}, "threads is -1"),
        ({"accuracy": "best"}, "accuracy is \"best\" but must be draft (1e-2), standard (1e-3)"),
        ({"accuracy": 0.5}, "accuracy is \"0.5\" but must be"),
        ({"accuracy": "paper", "precision": "f32"}, "which chooses it"),
        ({"accuracy": "reference", "backend": "cpu"}, "which chooses it"),
    ]:
        with pytest.raises(squealmap.InputError, match=re.escape(words)):
            squealmap.run(FIRST, **keys)
    for keys in [{"backend": 5}, {"strict": "yes"}, {"adapter": 3}, {"precision": []}, {"accuracy": True}, {"accuracy": []}]:
        with pytest.raises(TypeError):
            squealmap.run(FIRST, **keys)


def test_wrong_instances():
    for keys, words in [
        ({"at": {"mu_s": 0.3}}, "belt_velocity"),
        ({"at": "mu_s"}, "name=value"),
        ({"at": {"mu_s": "a", "belt_velocity": 1}}, "mu_s"),
        ({"at": {"mass": 1}}, "mass"),
        ({"instance": 35}, "--instance 35: the sweep has 35 instances, numbered from 0 to 34"),
        ({"instance": -1}, "from 0 on"),
        ({"instance": 10**30}, "from 0 on"),
        ({"instance": 1, "at": "mu_s=1"}, "both choose"),
        ({"instance": 1, "samples_per_period": 0}, "samples_per_period"),
        ({"instance": 1, "samples_per_period": 20000}, "samples_per_period"),
    ]:
        with pytest.raises(squealmap.InputError, match=re.escape(words)):
            squealmap.trace(FIRST, **keys)


def test_files_that_are_none(tmp_path):
    (tmp_path / "empty").write_text("")
    (tmp_path / "binary").write_bytes(bytes(range(256)) * 20)
    (tmp_path / "one.csv").write_text("a,b\n1\n")
    for path in [tmp_path, tmp_path / "none", tmp_path / "binary", tmp_path / "one.csv", "", "\0", "/dev/zero"]:
        for call in [squealmap.run, squealmap.modes, squealmap.identify, squealmap.fit, squealmap.fem, squealmap.open]:
            with pytest.raises((squealmap.InputError, ValueError)):
                call(path)
    for call in [squealmap.identify, squealmap.fit, squealmap.fem, squealmap.open]:
        for wrong in [None, 5, {}, [], object()]:
            with pytest.raises(TypeError):
                call(wrong)


def test_studies_say_the_sentence_of_the_program(tmp_path, program, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "signals.csv").write_text("t,ax2\n" + "".join(f"{k / 1000},{k % 7}\n" for k in range(50)))
    (tmp_path / "points.csv").write_text("V,mu\n1,0.4\n")
    (tmp_path / "study.toml").write_text("[mesh]\nfile = 3\n")
    (tmp_path / "tuples.toml").write_text('points = "t.csv"\n')
    (tmp_path / "t.csv").write_text("mu_s,mu_d,belt_velocity\n0.5,0.3,1\n")
    for words, call in [
        (["identify", "signals.csv"], lambda: squealmap.identify("signals.csv")),
        (["fit", "points.csv"], lambda: squealmap.fit("points.csv")),
        (["fem", "study.toml"], lambda: squealmap.fem("study.toml")),
        (["modes", "tuples.toml"], lambda: squealmap.modes("tuples.toml")),
        (["trace", "tuples.toml"], lambda: squealmap.trace("tuples.toml")),
        (["plot", "nowhere"], lambda: squealmap.open("nowhere")),
    ]:
        ended = program(*words, "--json", cwd=tmp_path)
        said = json.loads(ended.stdout)["error"]
        with pytest.raises(squealmap.InputError) as raised:
            call()
        if words[0] != "plot":
            assert str(raised.value) == said


def test_a_fault_of_the_program_is_an_exception():
    """A panic in a thread of the compiled part does not end the interpreter: that of a writer of tables with a broken path."""
    text = """
        import squealmap
        from squealmap import _squealmap
        for arguments in [["--figure"], ["/nowhere"], ["--help"], ["--version"], []]:
            try:
                _squealmap.figure(arguments)
            except squealmap.InputError as why:
                assert str(why)
            else:
                raise SystemExit("nothing was raised")
        print("alive")
    """
    ended = subprocess.run([sys.executable, "-c", textwrap.dedent(text)], capture_output=True, text=True)
    assert ended.stdout.strip() == "alive", ended.stderr


def test_a_stop_goes_from_process_to_process() -> None:
    import pickle

    stop = squealmap.Interrupted({"a": 1}, 2, 3)  # type: ignore[arg-type]
    again = pickle.loads(pickle.dumps(stop))
    assert str(again) == str(stop) and again.dataset == {"a": 1}


def test_numbers_of_numpy_are_threads() -> None:
    numpy = pytest.importorskip("numpy")
    from squealmap._engine import engine_of

    assert engine_of(threads=numpy.int64(2))["threads"] == 2
    for threads in (True, 0, 1025, 2.5, "2"):
        with pytest.raises(squealmap.InputError, match="threads is"):
            engine_of(threads=threads)


def test_what_is_no_dataset_is_not_drawn(tmp_path: pathlib.Path) -> None:
    for given in (None, 3, {}):
        with pytest.raises(squealmap.InputError, match="plot takes an xarray.Dataset"):
            squealmap.plot(given)  # type: ignore[arg-type]
    deep = "<g opacity='.5'>" * 1000 + "</g>" * 1000
    svg = f"<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'>{deep}</svg>"
    with pytest.raises(squealmap.Error, match="1001 elements within one another"):
        squealmap.Figure(svg).save(tmp_path / "a.png")


def test_an_argument_of_a_wrong_type_is_named(tmp_path) -> None:
    (tmp_path / "points.csv").write_text("V,mu\n1,0.4\n")
    for call, keys, words in [
        (squealmap.identify, {"rate": "x"}, "rate: must be real number, not str"),
        (squealmap.identify, {"band": 3}, "band: "),
        (squealmap.identify, {"time": 3}, "time: "),
        (squealmap.identify, {"velocity": 3}, "velocity is the name of a column, not int"),
        (squealmap.fit, {"temperatures": ["a"]}, "temperatures: must be real number, not str"),
        (squealmap.fit, {"law": 4}, "law: "),
    ]:
        with pytest.raises(TypeError, match=f"^{re.escape(words)}"):
            call(tmp_path / "points.csv", **keys)
    with pytest.raises(TypeError, match="^backend: "):
        squealmap.run(FIRST, backend=4)


def test_sentences_hold_no_control_characters(tmp_path, program) -> None:
    escape = "\x1b[31m"
    for call in [squealmap.run, squealmap.identify, squealmap.open, squealmap.fem]:
        with pytest.raises(squealmap.InputError) as raised:
            call(tmp_path / escape)
        assert "\x1b" not in str(raised.value) and "\\u{1b}[31m" in str(raised.value)
    ended = program("run", escape + ".toml", cwd=tmp_path)
    assert ended.returncode == 2 and "\\u{1b}[31m.toml" in ended.stderr and "\x1b" not in ended.stderr


def test_an_empty_sweep_is_told_by_what_is_missing() -> None:
    with pytest.raises(squealmap.InputError, match="^the sweep: `belt_velocity` is missing"):
        squealmap.run({})


def test_what_memory_does_not_hold_is_refused() -> None:
    axes = {"mu_s": {"from": 0.2, "to": 0.6, "points": 100_000}, "belt_velocity": {"from": 0.3, "to": 6.3, "points": 10_000}}
    with pytest.raises(squealmap.InputError, match="1000000000 instances but modes are followed in at most"):
        squealmap.modes({**FIRST, "axes": axes})
    long = {**FIRST, "response": {"settle": "1000 periods", "measure": "1000 periods"}}
    with pytest.raises(squealmap.InputError, match="the trace would have 20000000 rows"):
        squealmap.trace(long, instance=4, samples_per_period=10_000)


def test_a_trace_without_a_motion_is_the_sentence_of_the_program(tmp_path, program) -> None:
    endless = {**FIRST, "response": {"settle": "1000000 periods", "measure": "1000000 periods"}}
    with pytest.raises(squealmap.Error, match="^the instance has no result: `step_too_large`") as raised:
        squealmap.trace(endless, instance=2, samples_per_period=1)
    assert not isinstance(raised.value, squealmap.InputError)


def test_columns_without_an_order_are_none() -> None:
    numpy = pytest.importorskip("numpy")
    masked = numpy.ma.array([0.3, 0.4], mask=[False, True])
    for values in [{0.4, 0.3}, masked]:
        with pytest.raises(TypeError, match="points.mu_s is"):
            squealmap.linear({"friction": {"law": "bilinear"}, "points": {"mu_s": values, "mu_d": [0.2, 0.2]}})
    for values in [b"abc", "abc", {1.0, 2.0}, 5]:
        with pytest.raises(TypeError, match="axis mu_s"):
            squealmap.Sweep().axis("mu_s", values)


def test_codes_have_no_mean() -> None:
    pytest.importorskip("xarray")
    found = squealmap.linear({**FIRST, "axes": {**FIRST["axes"], "theta": {"from": 0.0, "to": 0.3, "points": 3}}})
    mean = found.mean("theta", keep_attrs=True)
    with pytest.raises(squealmap.InputError, match="no codes"):
        mean.squealmap.plot()
    with pytest.raises(squealmap.InputError, match="no codes"):
        squealmap.names(mean["type"])
    with pytest.raises(squealmap.InputError, match="`status`"):
        found[["type"]].squealmap.plot()
    with pytest.raises(squealmap.InputError, match="some"):
        found.isel(mu_s=0, belt_velocity=0, theta=0).squealmap.plot()


def test_numbers_of_numpy_are_numbers() -> None:
    numpy = pytest.importorskip("numpy")
    found = squealmap.trace(FIRST, instance=2, samples_per_period=numpy.int64(20))
    assert found.sizes == squealmap.trace(FIRST, instance=2, samples_per_period=20).sizes
    with pytest.raises(squealmap.InputError, match="accuracy is"):
        squealmap.run(FIRST, accuracy=numpy.float32(0.5))
