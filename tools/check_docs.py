#!/usr/bin/env python3
"""Runs every command and every snippet of README.md and docs/, so that what a reader copies works.

    tools/check_docs.py target/release/ligament                   # all pages
    tools/check_docs.py target/release/ligament docs/guide/*.md   # some
    tools/check_docs.py target/release/ligament --write-pictures  # and stores the pictures of docs/guide that the commands drew

A page is run from top to bottom in one shell, in a copy of cases, meshes and tools. What stands in an HTML comment right above a
block says what the block is, and is not seen by readers:

    file: NAME             any block: written to NAME in the folder that the commands have come to
    not run: WHY           any block: left out, and listed with the reason
    needs: MODULE          any block: left out where this Python has no such module
    may fail: WHY          sh: a failure of its last command is what the page is about
    without gmsh: COMMAND  sh: run in place of the block where there is no program gmsh
    case in FOLDER         toml: a whole case, as if it lay in this folder
    study in FOLDER        toml: a whole study
    into CASE              toml: keys that are put into this case; lists take the place of lists
    data                   toml, json: read, and no more
    output                 text: lines that the block of commands before it says; numbers may be others
    output of: COMMAND     text: lines that a command says, which is run for that

A `toml` block needs one of them. `<!-- before: COMMAND -->` anywhere in a page is run before its blocks; the command `have FOLDER CASE OPTIONS`
is `ligament run` where no earlier page has left the folder of results.
Blocks of `python` run where the package ligament is installed beside this Python, and are read by its compiler elsewhere. Commands in
the text (`ligament plot --crack`) must have the options that they name.
"""
import argparse
import ast
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
import tomllib
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCRATCH = ROOT / "target" / "docs"
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
DIRECTIVE = re.compile(r"<!-- ((?:(?!-->).)*) -->\s*\Z", re.DOTALL)
BEFORE = re.compile(r"<!-- before: (.*?) -->", re.DOTALL)
PICTURE = re.compile(r"!\[[^\]]*\]\(([^)]+)\)")
NUMBER = re.compile(r"[-+]?\d[\d.]*(?:e[-+]?\d+)?")
INLINE = re.compile(r"`(ligament [^`]+)`")
MARK = "::block "
PRELUDE = """set -euo pipefail
have() { [ -d "$1" ] || ligament run "${@:2}" --out "$1" --quiet; }
"""


@dataclass
class Block:
    """A fenced block of a page, with the first line of its text and what the comment above it says."""

    language: str
    text: str
    line: int
    directive: str

    def option(self, name):
        """What follows `name` in the comment above the block; None where the comment says something else."""
        if self.directive == name:
            return ""
        return self.directive[len(name) + 1 :].strip() if self.directive.startswith((name + ":", name + " ")) else None


class Page:
    """A page: its blocks in order."""

    def __init__(self, path):
        self.path = path
        self.name = str(path.relative_to(ROOT))
        self.text = path.read_text()
        self.blocks = [self.block(found) for found in FENCE.finditer(self.text)]

    def block(self, found):
        above = DIRECTIVE.search(self.text[: found.start()])
        directive = " ".join(above[1].split()) if above else ""
        line = self.text.count("\n", 0, found.start()) + 2
        return Block(found[1], found[2], line, "" if directive.startswith("before:") else directive)


class Failure(Exception):
    """What is wrong with a block or a page, for people."""


def commands(text):
    """The commands of a block of a shell: lines that are no comments, with their continuations."""
    lines = text.replace("\\\n", " ").splitlines()
    return [line for line in lines if line.strip() and not line.lstrip().startswith("#")]


def toml(value):
    """A value as TOML on one line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(inner)}" for key, inner in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value) if isinstance(value, (str, bool)) else repr(value)


def merged(base, more):
    """The tables `base` and `more` in one; where both have a key that is no table, that of `more`."""
    tables = {key for key in more if isinstance(more[key], dict) and isinstance(base.get(key), dict)}
    return base | {key: merged(base[key], more[key]) if key in tables else more[key] for key in more}


def heredoc(name, text):
    """The lines of a shell that write `text` to a file."""
    return f"mkdir -p $(dirname {shlex.quote(name)})\ncat > {shlex.quote(name)} <<'END_OF_BLOCK'\n{text}END_OF_BLOCK\n"


def fragment(block, number):
    """The lines of a shell that try a block of TOML: as a case, a study, or a part of a case."""
    name = f"from-docs-{number}.toml"
    if (folder := block.option("case in")) is not None:
        return heredoc(f"{SCRATCH}/{folder}/{name}", block.text) + f"ligament check {SCRATCH}/{folder}/{name}\n"
    if (folder := block.option("study in")) is not None:
        return heredoc(f"{SCRATCH}/{folder}/{name}", block.text) + f"ligament sweep {SCRATCH}/{folder}/{name} --list\n"
    if (case := block.option("into")) is not None:
        base = tomllib.loads((ROOT / case).read_text())
        whole = merged(base, tomllib.loads(block.text))
        if "stage" in whole:
            whole.get("fracture", {}).pop("steps", None)
        text = "".join(f"{json.dumps(key)} = {toml(value)}\n" for key, value in whole.items())
        path = f"{SCRATCH}/{Path(case).parent}/{name}"
        return heredoc(path, text) + f"ligament check {path}\n"
    raise Failure("say in a comment above the block what it is: file, case in, study in, into, data or not run")


def lines_of(block, number, gmsh):
    """The lines of a shell that try a block; none where there is nothing to run."""
    if (name := block.option("file")) is not None:
        return heredoc(name, block.text)
    if (command := block.option("output of")) is not None:
        return command + "\n"
    if block.language == "toml":
        return fragment(block, number)
    if block.language == "sh":
        if (command := block.option("without gmsh")) is not None and not gmsh:
            return command + "\n"
        text = block.text if block.text.endswith("\n") else block.text + "\n"
        return f"( set -e; {text}) || true\n" if block.option("may fail") is not None else text
    return ""


def words(line):
    """A line of output without its numbers and the width of its gaps."""
    return " ".join(NUMBER.sub("#", line).split())


def unsaid(block, said):
    """The lines of a block of text that are not among those of an output; `...` and the command itself aside."""
    there = {words(line) for line in said.splitlines()}
    lines = [line for line in block.text.splitlines() if line.strip() not in ("", "...") and not line.startswith("$ ")]
    return [line for line in lines if words(line) not in there]


def read(block):
    """Reads a block that no shell runs, and fails where its language does not."""
    if block.language == "json":
        text = block.text.strip()
        json.loads(text if text.startswith(("{", "[")) else "{" + text + "}")
    elif block.language == "toml":
        tomllib.loads(block.text)
    elif block.language == "python":
        ast.parse(block.text)


class Check:
    """The check of pages with one program: what was counted, left out and failed."""

    def __init__(self, program):
        self.counts = Counter()
        self.left_out = []
        self.failures = []
        self.environment = os.environ | {"PATH": f"{SCRATCH}/bin:{Path(sys.executable).parent}:{os.environ['PATH']}", "NO_COLOR": "1", "HOME": str(SCRATCH)}
        self.prepare(program)
        self.gmsh = self.works("gmsh", "-version")
        self.package = self.works(sys.executable, "-c", "import ligament")
        self.helps = {}

    def prepare(self, program):
        shutil.rmtree(SCRATCH, ignore_errors=True)
        for folder in ("cases", "meshes", "tools"):
            shutil.copytree(ROOT / folder, SCRATCH / folder, ignore=shutil.ignore_patterns("__pycache__"))
        (SCRATCH / "bin").mkdir()
        (SCRATCH / "bin" / "ligament").symlink_to(Path(program).resolve())

    def works(self, *command):
        """Whether a command can be run here."""
        try:
            return subprocess.run(command, env=self.environment, capture_output=True, check=False).returncode == 0
        except OSError:
            return False

    def script(self, page):
        """The shell script of a page: its blocks from top to bottom, each announced by its line."""
        script = [PRELUDE, *(f"{command}\n" for command in BEFORE.findall(page.text))]
        python = []
        for number, block in enumerate(page.blocks):
            reason = self.reason(block)
            self.counts["blocks"] += 1
            self.counts[f"{block.language or 'plain'} blocks"] += 1
            if reason is not None:
                self.left_out.append(f"{page.name}:{block.line}: {len(commands(block.text))} line(s): {reason}")
                self.counts["blocks left out"] += 1
                continue
            try:
                read(block)
                lines = "" if block.option("data") is not None else lines_of(block, number, self.gmsh)
            except (Failure, ValueError, SyntaxError) as error:
                self.failures.append(f"{page.name}:{block.line}: {error}")
                continue
            if block.language == "python" and self.package:
                python.append(block.text)
                lines = heredoc("from_docs.py", "\n".join(python)) if block is self.last(page, "python") else ""
                lines += f"{shlex.quote(sys.executable)} from_docs.py\n" if lines else ""
            if lines:
                script.append(f"echo '{MARK}{block.line}'\n{lines}")
                self.counts["blocks run"] += 1
                self.counts["commands run"] += len(commands(block.text)) if block.language == "sh" else 0
        return "".join(script)

    def reason(self, block):
        """Why a block is not tried here; None where it is."""
        if (module := block.option("needs")) is not None and not self.works(sys.executable, "-c", f"import {module}"):
            return f"this Python has no {module}"
        return block.option("not run")

    @staticmethod
    def last(page, language):
        return [block for block in page.blocks if block.language == language][-1]

    def run(self, page):
        """Runs a page, and notes the block that failed with the end of what it said."""
        began = time.monotonic()
        script = self.script(page)
        done = subprocess.run(["bash", "-c", script], cwd=SCRATCH, env=self.environment, text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode:
            before, _, after = done.stdout.rpartition(MARK)
            line, _, said = after.partition("\n") if before or after else ("1", "", done.stdout)
            self.failures.append(f"{page.name}:{line.strip()}: exit code {done.returncode}\n{said[-1500:]}")
        else:
            self.outputs(page, done.stdout)
        self.options(page)
        seconds = time.monotonic() - began
        if seconds > 0.5:
            print(f"{seconds:6.1f} s  {page.name}", flush=True)

    def outputs(self, page, stdout):
        """Blocks of text that are called outputs hold what was said."""
        said = {}
        for part in stdout.split(MARK)[1:]:
            line, _, text = part.partition("\n")
            said[int(line)] = text
        before = None
        for block in page.blocks:
            if block.option("output of") is not None or block.option("output") is not None:
                self.counts["outputs compared"] += 1
                if missing := unsaid(block, said.get(block.line, said.get(before, ""))):
                    self.failures.append(f"{page.name}:{block.line}: not said by the commands: {missing[0]}")
            elif block.line in said:
                before = block.line

    def options(self, page):
        """Commands in the text of a page name a command of the program and options that it has."""
        for text in INLINE.findall(FENCE.sub("", page.text)):
            words = text.split()
            command = words[1].strip(".,") if len(words) > 1 else ""
            if not re.fullmatch(r"[a-z]+", command):
                continue
            if command not in self.helps:
                told = subprocess.run(["ligament", command, "--help"], env=self.environment, text=True, capture_output=True, check=False)
                self.helps[command] = told.stdout if told.returncode == 0 else None
            known = self.helps[command]
            self.counts["commands in the text"] += 1
            unknown = [option for option in re.findall(r"--[a-z][a-z-]*", text) if known is not None and option not in known]
            if known is None or unknown:
                self.failures.append(f"{page.name}: `{text}`: {'no such command' if known is None else 'no ' + ', '.join(unknown)}")

    def pictures(self, page, write):
        """Pictures of the guide were drawn by the commands of their page; `write` stores them."""
        for link in PICTURE.findall(page.text):
            stored = page.path.parent / link
            if stored.parent.name != "pictures":
                continue
            drawn = list(SCRATCH.rglob(stored.name))
            self.counts["pictures"] += 1
            if not drawn:
                self.failures.append(f"{page.name}: no command draws {stored.name}")
            elif write:
                stored.parent.mkdir(exist_ok=True)
                shutil.copyfile(drawn[0], stored)


def pages(names):
    """The pages to check: README.md first, because later ones use its results."""
    found = [Path(name).resolve() for name in names] or [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return [Page(path) for path in found]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="the program `ligament`")
    parser.add_argument("pages", nargs="*", help="[default: README.md and all of docs]")
    parser.add_argument("--write-pictures", action="store_true", help="store the pictures of docs/guide/pictures anew")
    arguments = parser.parse_args()
    check = Check(arguments.program)
    began = time.monotonic()
    for page in pages(arguments.pages):
        check.run(page)
        check.pictures(page, arguments.write_pictures)
    print("left out:", *check.left_out, sep="\n  ")
    print(", ".join(f"{count} {name}" for name, count in sorted(check.counts.items())), f"in {time.monotonic() - began:.0f} s")
    print(f"gmsh: {'used' if check.gmsh else 'not here, stored meshes'}; Python package: {'used' if check.package else 'not here, read only'}")
    if check.failures:
        sys.exit("\n".join(["failed:", *check.failures]))


if __name__ == "__main__":
    main()
