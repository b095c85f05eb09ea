# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the blocks of one manual, in a copy of the repository."""
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading

import manual as manual_text
from shown import missing_line

HERE = os.path.dirname(os.path.abspath(__file__))
ONLY_LINKS = {".github/CHANGELOG.md"}
KINDS = {"sh": "run", "cpp": "run", "cmake": "run", "python": "run", "made by": "run", "text": "checked", "json": "checked"}
WHOLE = {"cpp": re.compile(r"\bmain\s*\("), "cmake": re.compile(r"^\s*project\s*\(", re.MULTILINE | re.IGNORECASE)}
SLOW_S = 5  # of processor time: the list names such blocks


class Library:
    """The built library, installed into a temporary directory when it is first needed."""

    def __init__(self, build, prefix, scratch):
        self.build, self.prefix, self.scratch, self.lock = build, prefix, scratch, threading.Lock()

    def environment(self):
        """What lets pkg-config and CMake find it; nothing if there is no library."""
        with self.lock:
            if not self.prefix and self.build:
                self.prefix = os.path.join(self.scratch, "prefix")
                subprocess.run(["cmake", "--install", self.build, "--prefix", self.prefix, "--component", "development"],
                               check=True, stdout=subprocess.DEVNULL)
        if not self.prefix:
            return {}
        places = [folder for folder, _, _ in os.walk(self.prefix) if os.path.basename(folder) == "pkgconfig"]
        return {"PKG_CONFIG_PATH": os.pathsep.join(places), "CMAKE_PREFIX_PATH": self.prefix}


class Runner:
    """Runs one manual. `faults` are triples of a line, what is wrong there, and details; `notes` are pairs of a line and a remark."""

    def __init__(self, path, copy, options, library):
        self.path, self.copy, self.options, self.library = path, copy, options, library
        with open(os.path.join(options.root, path), encoding="utf-8") as stream:
            self.manual = manual_text.Manual(stream.read())
        if path in ONLY_LINKS:
            self.manual.parts, self.manual.faults = [], []
        self.parts = self.manual.parts
        self.faults = [(line, message, "") for line, message in self.manual.faults]
        self.counts, self.notes, self.new_tables = {"run": 0, "checked": 0, "not run": 0}, [], []
        self.printed, self.why_not_printed = None, None  # by the last block that was to be run
        self.program_text = None  # the last C++ program
        self.environment, self.session = {}, None

    def fault(self, part, message, details="", last=None):
        """`last`: so many of the last lines of the details are given."""
        lines = details.rstrip().splitlines()
        if last and len(lines) > last:
            lines = ["..."] + lines[-last:]
        self.faults.append((part.line, message, "\n".join(lines)))

    def not_run(self, part, reason):
        self.counts["not run"] += 1
        self.notes.append((part.line, f"{part.language or 'no language'}, not run: {reason}"))

    def nothing_printed(self, part, reason):
        self.not_run(part, reason)
        self.printed, self.why_not_printed = None, reason

    def guard(self):
        """A folder of commands that refuse: no block changes the machine."""
        folder = tempfile.mkdtemp(dir=self.options.scratch)
        for name in ("apt", "apt-get", "sudo"):
            path = os.path.join(folder, name)
            self.write(path, "#!/bin/sh\necho \"$0 changes the machine: mark the block as not run\" >&2\nexit 1\n")
            os.chmod(path, 0o755)
        return folder

    def run(self):
        places = (self.guard(), os.path.dirname(self.options.program), os.environ["PATH"])
        self.environment = {key: value for key, value in os.environ.items() if not key.startswith(("EARTHTOP_", "XDG_", "PYTHON"))}
        self.environment.update({
            "PATH": os.pathsep.join(places), "HOME": tempfile.mkdtemp(dir=self.options.scratch), "NO_COLOR": "1", "COLUMNS": "100",
            "LC_ALL": "C.UTF-8", "TERM": "dumb", "PAGER": "cat", "MANPAGER": "cat", "MPLBACKEND": "agg", "PYTHONDONTWRITEBYTECODE": "1",
            # There may be no network: what needs one fails everywhere.
            **{name: "http://127.0.0.1:9" for name in ("http_proxy", "https_proxy", "HTTP_PROXY", "HTTPS_PROXY")}})
        if any(self.needs_library(part) for part in self.parts):
            self.environment.update(self.library.environment())
        try:
            for part in self.parts:
                self.run_part(part)
        finally:
            self.end_session()
        for judged in (manual_text.dead_links, manual_text.other_titles):
            self.faults += [(line, message, "") for line, message in judged(self.path, self.copy)]

    @staticmethod
    def needs_library(part):
        return part.reason is None and (part.language in WHOLE or part.language == "sh" and
                                        re.search("pkg-config|find_package", part.text) is not None)

    def run_part(self, part):
        if part.language == "made by":
            self.make_table(part)
            return
        if part.file:
            self.write(os.path.join(self.copy, part.file), part.text)
        if part.reason is not None:
            if part.language in ("text", "json", ""):
                self.not_run(part, part.reason)
            else:
                self.nothing_printed(part, part.reason)
            if "fragment" in part.reason and self.is_whole(part):
                self.fault(part, "is marked as a fragment, but it is complete")
        elif part.language == "text" and self.why_not_printed:
            self.not_run(part, f"as the block before it, {self.why_not_printed}")
        elif part.language in KINDS:
            if part.status is not None and part.language in ("text", "cmake", "python"):
                self.fault(part, f"a status is expected of a block of the language {part.language}")
            getattr(self, "run_" + part.language)(part)
        else:
            self.fault(part, f"nothing checks a block of {part.language or 'no language'}; it needs a language or a mark")

    @staticmethod
    def write(path, text):
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(text)

    def start(self, part, command, stderr=subprocess.STDOUT):
        """Runs a command of a part; gives its status, None if its time was over, and its output."""
        with tempfile.TemporaryFile() as output:
            process = subprocess.Popen(command, cwd=self.copy, env=self.environment, stdin=subprocess.DEVNULL, stdout=output,
                                       stderr=stderr, start_new_session=True)
            late = threading.Event()

            def stop():
                late.set()
                os.killpg(process.pid, signal.SIGKILL)

            timer = threading.Timer(self.options.timeout, stop)
            timer.start()
            _, status, usage = os.wait4(process.pid, 0)
            timer.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            try:
                os.killpg(process.pid, signal.SIGTERM)  # what it left in the background
            except ProcessLookupError:
                pass
            output.seek(0)
            printed = output.read().decode("utf-8", "replace")
        if usage.ru_utime + usage.ru_stime > SLOW_S:
            self.notes.append((part.line, f"{part.language}, took {usage.ru_utime + usage.ru_stime:.0f} s of processor time"))
        return None if late.is_set() else process.returncode, printed

    def judge(self, part, status, printed, culprit=""):
        expected = getattr(part, "status", None) or 0
        if status is None:
            self.fault(part, f"takes more than {self.options.timeout:g} s{culprit}", printed, last=20)
        elif status != expected:
            self.fault(part, f"status {status} instead of {expected}{culprit}", printed, last=20)
        return status == expected

    def run_and_judge(self, part, command, failed=None):
        """The command must end with the status of the block; what it prints can be shown. `failed` may come to name what fails."""
        self.counts["run"] += 1
        status, self.printed = self.start(part, command)
        self.why_not_printed = None
        culprit = ""
        if failed and os.path.exists(failed):
            with open(failed, encoding="utf-8") as stream:
                culprit = ", from " + " ".join(stream.read().split())
        self.judge(part, status, self.printed, culprit)

    def run_sh(self, part):
        failed = os.path.join(tempfile.mkdtemp(dir=self.options.scratch), "failed")
        trap = f"trap 'printf \"line %s: %s\" $((LINENO + {part.line})) \"$BASH_COMMAND\" >{shlex.quote(failed)}' ERR; "
        self.run_and_judge(part, ["bash", "-euo", "pipefail", "-c", trap + part.text], failed)

    def run_text(self, part):
        if self.printed is None:
            self.fault(part, "nothing was printed before that it could show; it needs a mark")
            return
        self.counts["checked"] += 1
        line = missing_line(part.text, self.printed)
        if line is not None:
            self.fault(part, f"not printed, or not in this order: {line.strip()}", self.printed)

    def json_status(self, part):
        """None if it is no JSON object, else the status of the program that checks it; and what is said of it."""
        try:
            document = json.loads(part.text)
        except ValueError as error:
            return None, str(error)
        if not isinstance(document, dict):
            return None, "no object"
        with tempfile.NamedTemporaryFile("w", suffix=".json", dir=self.copy, encoding="utf-8") as file:
            file.write(part.text)
            file.flush()
            study = "axes" in document or "collect" in document
            return self.start(part, ["earthtop", "study", file.name, "--dry-run"] if study else ["earthtop", "check", file.name])

    def run_json(self, part):
        self.counts["checked"] += 1
        status, said = self.json_status(part)
        if status is None:
            self.fault(part, f"not a JSON document ({said}); a fragment needs a mark")
        else:
            self.judge(part, status, said)

    def is_whole(self, part):
        if part.language == "json":
            return self.json_status(part)[0] == 0
        return part.language in WHOLE and WHOLE[part.language].search(part.text) is not None

    def can_be_built(self, part):
        if not self.is_whole(part):
            self.fault(part, "is not complete; a fragment needs a mark")
        elif not self.library.prefix:
            self.nothing_printed(part, "without a build there is no library")
        else:
            return True
        return False

    def run_cpp(self, part):
        if not self.can_be_built(part):
            return
        self.program_text = part.text
        folder = tempfile.mkdtemp(dir=self.options.scratch)
        source, program = os.path.join(folder, "program.cpp"), os.path.join(folder, "program")
        self.write(source, part.text)
        status, said = self.start(part, ["bash", "-c", 'flags=$(pkg-config --cflags --libs --static earthtop-workbench) && '
                                         '"${@:3}" -std=gnu++20 "$1" $flags -o "$2"', "compile", source, program,
                                         *shlex.split(os.environ.get("CXX", "g++"))])
        if status == 0:
            self.run_and_judge(part, [program])
        else:
            self.counts["run"] += 1
            self.fault(part, "does not compile", said)

    def run_cmake(self, part):
        if not self.can_be_built(part):
            return
        folder = tempfile.mkdtemp(dir=self.options.scratch)
        self.write(os.path.join(folder, "CMakeLists.txt"), part.text)
        for source in re.findall(r"[\w./-]+\.cpp\b", part.text):
            if os.path.exists(os.path.join(self.copy, source)):
                with open(os.path.join(self.copy, source), encoding="utf-8") as stream:
                    self.write(os.path.join(folder, source), stream.read())
            elif self.program_text is not None:
                self.write(os.path.join(folder, source), self.program_text)
        self.run_and_judge(part, ["cmake", "-G", "Ninja", "-S", folder, "-B", os.path.join(folder, "build")])  # as the presets do

    def run_python(self, part):
        if not self.options.python:
            self.nothing_printed(part, "the tests of the Python package run it, with --python")
            return
        if not self.session:
            self.session = subprocess.Popen([sys.executable, "-W", "error", os.path.join(HERE, "python_session.py")], cwd=self.copy,
                                            env=dict(self.environment, PYTHONPATH=self.options.python), encoding="utf-8",
                                            stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.counts["run"] += 1
        self.session.stdin.write(json.dumps({"text": part.text, "line": part.line, "name": self.path}) + "\n")
        self.session.stdin.flush()
        timer = threading.Timer(self.options.timeout, self.session.kill)
        timer.start()
        answer = self.session.stdout.readline()
        timer.cancel()
        if not answer:
            self.fault(part, f"Python ended, or takes more than {self.options.timeout:g} s")
            self.end_session()
            return
        answer = json.loads(answer)
        self.printed, self.why_not_printed = answer["output"], None
        if answer["failed"]:
            self.fault(part, "fails in Python", answer["output"])

    def end_session(self):
        if self.session:
            self.session.communicate()
            self.session = None

    def make_table(self, table):
        if table.reason is not None:
            self.not_run(table, table.reason)
            return
        self.counts["run"] += 1
        with tempfile.TemporaryFile() as errors:
            status, made = self.start(table, ["bash", "-euo", "pipefail", "-c", table.command], stderr=errors)
            errors.seek(0)
            said = errors.read().decode("utf-8", "replace")
        if not self.judge(table, status, said):
            return
        old, made = self.manual.lines[table.first:table.last], made.strip("\n").splitlines()
        first, last = 0, len(old)  # empty lines around it, and a fence, are the manual's
        while first < last and not old[first].strip():
            first += 1
        while last > first and not old[last - 1].strip():
            last -= 1
        if last - first >= 2 and old[first].startswith("```") and old[last - 1] == "```":
            first, last = first + 1, last - 1
        if old[first:last] == made:
            return
        if self.options.write:
            self.new_tables.append((table.first + first, table.first + last, made))
        else:
            changed = next((line for line in made if line not in old[first:last]), "(lines are moved, or there are more of them)")
            self.fault(table, f"is not what is printed now, --write puts it right: {table.command}", changed)

    def write_tables(self):
        lines = self.manual.lines
        for first, last, made in reversed(self.new_tables):
            lines[first:last] = made
        if self.new_tables:
            self.write(os.path.join(self.options.root, self.path), "\n".join(lines) + "\n")

    def count_only(self):
        for part in self.parts:
            if part.reason is not None:
                self.not_run(part, part.reason)
            elif part.language in KINDS:
                self.counts[KINDS[part.language]] += 1
            else:
                self.fault(part, "nothing checks it")

    def report(self):
        for line, message, details in sorted(self.faults):
            print(f"{self.path}:{line}: {message}")
            lines = details.splitlines()
            for one in lines[:60] + ([f"... {len(lines) - 60} lines more"] if len(lines) > 60 else []):
                print("    | " + one)

    def summary(self):
        print(f"{self.path}: " + ", ".join(f"{number} {what}" for what, number in self.counts.items()) +
              (f", {len(self.faults)} faults" if self.faults else ""))
        lines_of = {}
        for line, note in sorted(self.notes):
            lines_of.setdefault(note, []).append(str(line))
        for note, lines in lines_of.items():
            print(f"  line{'s' if len(lines) > 1 else ''} {', '.join(lines)}: {note}")
