"""Licences and sources of every crate in Cargo.lock against deny.toml, where cargo-deny is not installed."""

import json
import re
import subprocess
import sys
import tomllib


def words(licence):
    """An SPDX expression in words; `/` is an old way to write OR, WITH belongs to the licence before it."""
    text = re.sub(r"\s+WITH\s+", "+WITH+", licence.replace("/", " OR "))
    return [word.replace("+WITH+", " WITH ") for word in re.findall(r"[()]|[^\s()]+", text)]


def allowed(licence, allow):
    """Whether the expression can be met by licences of `allow`; AND binds closer than OR."""
    rest = words(licence)

    def one():
        word = rest.pop(0)
        if word != "(":
            return word in allow
        value = either()
        rest.pop(0)
        return value

    def both():
        value = one()
        while rest and rest[0] == "AND":
            rest.pop(0)
            value = one() and value
        return value

    def either():
        value = both()
        while rest and rest[0] == "OR":
            rest.pop(0)
            value = both() or value
        return value

    return either()


def main():
    with open("deny.toml", "rb") as file:
        deny = tomllib.load(file)
    command = ["cargo", "metadata", "--locked", "--all-features", "--format-version", "1"]
    packages = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)["packages"]
    extra = {one["crate"]: one["allow"] for one in deny["licenses"]["exceptions"]}
    sources = {f"registry+{index}" for index in deny["sources"]["allow-registry"]}
    bad = []
    for package in packages:
        allow = set(deny["licenses"]["allow"]) | set(extra.get(package["name"], []))
        name = f"{package['name']} {package['version']}"
        if not package["license"] or not allowed(package["license"], allow):
            bad.append(f"{name}: the licence {package['license']} is not in deny.toml")
        if package["source"] not in sources | {None}:
            bad.append(f"{name}: comes from {package['source']}")
        if any(one["req"] == "*" for one in package["dependencies"]) and package["source"] is None:
            bad.append(f"{name}: depends on any version of a crate")
    for crate in extra.keys() - {package["name"] for package in packages}:
        bad.append(f"deny.toml: {crate} is no longer there, its exception is to go")
    print("\n".join(bad) or f"licences and sources of {len(packages)} crates are those of deny.toml")
    return 1 if bad else 0


sys.exit(main())
