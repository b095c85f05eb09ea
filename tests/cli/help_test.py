#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests what the program says of itself and how it fits the screen: help and manual agree, every example of the help can be
run, a misspelt word is answered with a suggestion, and prose has the width of the terminal or of COLUMNS.

usage: help_test.py PATH_OF_EARTHTOP [--examples]     --examples: run the examples, and nothing else
"""
import fcntl
import os
import pty
import re
import select
import shutil
import struct
import subprocess
import sys
import tempfile
import termios
import time

TOOL = os.path.abspath(sys.argv[1])
SECTION = re.compile(r"^(Usage:|To begin|Examples|Operands|Options|Exit status|Verbs|More)", re.MULTILINE)
# Not run: they take minutes, or need what a test machine may not have.
NOT_RUN = ("earthtop verify", "earthtop bench toy-top.json --brief", "earthtop man run | man -l -",
           "earthtop man --all /usr/local/share/man/man1", "source <(earthtop completion bash)",
           "earthtop completion fish > ~/.config/fish/completions/earthtop.fish")
# The two results differ, which is a negative answer.
STATUS = {"earthtop compare old/toy-top new/toy-top": 1, "earthtop compare old new --json | earthtop report - --out comparison.html": 1}
faults = []


def fault(text):
    faults.append(text)
    print("FAULT:", text, flush=True)


def environment(**more):
    kept = {name: value for name, value in os.environ.items() if name not in ("COLUMNS", "NO_COLOR", "TERM")}
    return {**kept, "PATH": os.path.dirname(TOOL) + os.pathsep + os.environ["PATH"], **more}


def run(*arguments, **more):
    """Runs the program with pipes."""
    return subprocess.run([TOOL, *arguments], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL,
                          env=environment(**more))


def on_terminal(columns, *arguments, **more):
    """What the program prints on a terminal of so many columns, which shows no colours."""
    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    text = b""
    with subprocess.Popen([TOOL, *arguments], stdin=subprocess.DEVNULL, stdout=slave, stderr=subprocess.PIPE,
                          env=environment(**{"NO_COLOR": "1", **more})) as program:
        # The terminal stays open here until all is read: a terminal that its last program closes may lose what is under way.
        ended = False
        while not ended:
            ended = program.poll() is not None
            while select.select([master], [], [], 0.01)[0]:
                text += os.read(master, 65536)
    os.close(slave)
    os.close(master)
    return text.decode("utf-8").replace("\r\n", "\n")


def section(text, title):
    """The lines of a help below a title, up to the next gap."""
    found = re.search(rf"^{title}\n((?:.+\n)*)", text, re.MULTILINE)
    return found[1] if found else ""


def examples_of(text):
    """The commands and purposes below "Examples" or "To begin"."""
    pairs = re.findall(r"^  (\S.*)\n((?:      .*\n)+)", section(text, "(?:Examples|To begin)"), re.MULTILINE)
    return [(command, " ".join(purpose.split())) for command, purpose in pairs]


def statuses_of(text):
    rows = re.findall(r"^  (\d+(?:, \d+)*)  +(\S.*\n(?:       .*\n)*)", section(text, "Exit status"), re.MULTILINE)
    return [(status, " ".join(meaning.split())) for status, meaning in rows]


def plain(roff):
    """A line of a manual page without its markup."""
    for mark, character in (("\\(aq", "'"), ("\\(ti", "~"), ("\\(ha", "^"), ("\\(ga", "`"), ("\\&", ""), ("\\-", "-"), ("\\ ", " "),
                            ("\\fB", ""), ("\\fI", ""), ("\\fR", ""), ("\\e", "\\")):
        roff = roff.replace(mark, character)
    return roff


def entries_of_page(page, title):
    """The tags and texts of a section of a manual page."""
    body = re.search(rf"^\.SH {title}\n(.*?)(?=^\.SH )", page, re.MULTILINE | re.DOTALL)
    entries = (body[1] if body else "").split(".TP\n")[1:]
    return [(plain(tag), " ".join(plain(text).split())) for tag, text in (entry.split("\n", 1) for entry in entries)]


def verbs():
    """The verbs that the program's help lists."""
    help_text = run("--help").stdout
    listed = help_text[help_text.index("\nTo begin"):help_text.index("\nOptions")]
    return re.findall(r"^  ([a-z]+)  +\S", listed, re.MULTILINE)


def check_texts(names):
    """Every verb has examples and exit statuses; its page in the manual has the same."""
    for name in [None, *names]:
        words = [name] if name else []
        text, page = run(*words, "--help").stdout, run("man", *words).stdout
        examples, statuses = examples_of(text), statuses_of(text)
        if not 2 <= len(examples) <= 4:
            fault(f"{name}: {len(examples)} examples")
        for command, _ in examples:
            if name and not re.search(rf"\bearthtop {name}\b", command):
                fault(f"{name}: an example of something else: {command}")
        if [status for status, _ in statuses if status != "1"] != ["0", "2", "3", "4", "129, 130, 143", "141"]:
            fault(f"{name}: exit statuses {statuses}")
        if (name in (None, "check", "compare", "plan", "study", "verify")) != ("1" in dict(statuses)):
            fault(f"{name}: status 1 is, or is not, among its statuses")
        if entries_of_page(page, "EXAMPLES") != examples:
            fault(f"{name}: the manual has other examples: {entries_of_page(page, 'EXAMPLES')}")
        if entries_of_page(page, "EXIT STATUS") != statuses:
            fault(f"{name}: the manual has other statuses: {entries_of_page(page, 'EXIT STATUS')}")
        for other in ([*words, "-h"], ["help", *words]):
            if (done := run(*other)).stdout != text or done.returncode != 0:
                fault(f"earthtop {' '.join(other)} is not the help")
    if run("help", "study", "merge").stdout != run("study", "merge", "--help").stdout:
        fault("help study merge is not the help of study merge")
    for option in ("-V", "--version"):
        if not re.fullmatch(r"earthtop \d+\.\d+\.\d+\S*\n", run(option).stdout):
            fault(f"{option}: {run(option).stdout!r}")


def check_suggestions():
    expected = [
        (["rnu"], 'there is no verb "rnu"; did you mean "run"?', "earthtop --help"),
        (["rnu", "--help"], 'there is no verb "rnu"; did you mean "run"?', "earthtop --help"),
        (["help", "rnu"], 'there is no verb "rnu"; did you mean "run"?', "earthtop --help"),
        (["man", "comapre"], 'there is no verb "comapre"; did you mean "compare"?', "earthtop --help"),
        (["help", "study", "mrege"], 'there is no verb "mrege"; did you mean "merge"?', "earthtop study --help"),
        (["run", "--froce", "top.json"], 'earthtop run has no option "--froce"; did you mean "--force"?', "earthtop run --help"),
        (["run", "--froce"], 'earthtop run has no option "--froce"; did you mean "--force"?', "earthtop run --help"),
        (["plan", "top.json", "--sgima=3"], 'earthtop plan has no option "--sgima"; did you mean "--sigma"?',
         "earthtop plan --help"),
        (["study", "merge", "--uot", "there"], 'earthtop study merge has no option "--uot"; did you mean "--out"?',
         "earthtop study merge --help"),
        (["completion", "bahs"], 'SHELL: "bahs" is not one of bash, zsh, fish; did you mean "bash"?', "earthtop completion --help"),
        (["frobnicate"], 'there is no verb "frobnicate"', "earthtop --help"),
        (["run", "--frobnicate"], 'earthtop run has no option "--frobnicate"', "earthtop run --help"),
        (["run", "top.json", "--jobs", "many"], '--jobs: "many" is not a whole number from 1 to 4096', "earthtop run --help"),
        (["run", "top.json", "--out"], "--out needs a value", "earthtop run --help"),
        (["schema", "--study", "--mapping"], "--study and --mapping cannot be given together", "earthtop schema --help"),
        (["\033[2J"], 'there is no verb "\\x1b[2J"', "earthtop --help"),
    ]
    for arguments, error, remedy in expected:
        done = run(*arguments)
        if (done.returncode, done.stdout, done.stderr) != (2, "", f"earthtop: error: {error}\nTry: {remedy}\n"):
            fault(f"earthtop {' '.join(arguments)}: status {done.returncode}, {done.stdout!r}, {done.stderr!r}")


def width_of(text):
    """The columns of the longest line that is prose: commands and tables are not broken."""
    prose = [line for line in text.splitlines() if not re.match(r"  (earthtop|source) ", line)]
    return max(len(line) for line in prose)


def words_of(text):
    """A text's words, but for figures that change from run to run."""
    return re.sub(r"[0-9.e-]+ s$|\d[\d,]* evaluations, [0-9.]+ s", "", " ".join(text.split()))


def check_sparkline():
    """A terminal shows the drift over time, and its largest value."""
    shown = on_terminal(80, "run", "toy-top.json", "--out", "wide", "--long", TERM="xterm", NO_COLOR="")
    if not re.search("^Drift       0 s [▁-█]*█[▁-█]* 60 s, the largest 0.00118 rad$", shown, re.MULTILINE):
        fault(f"no sparkline of the drift in {shown}")


def check_widths(names):
    """The same words on every screen, in lines of its width; 40 columns at least, 120 at most, and 80 without a screen."""
    commands = [["--help"], *([name, "--help"] for name in names), ["check", "toy-top.json"],
                ["run", "toy-top.json", "--out", "wide", "--long"],
                ["plan", "gyro.json", "--measure", "azimuth_deg", "--sigma", "0.01", "--every", "0.5"]]
    for command in commands:
        in_file = run(*command).stdout
        texts = {columns: on_terminal(columns, *command) for columns in (40, 80, 200)}
        if command[0] == "run":  # a terminal shows a sparkline, too
            texts = {columns: re.sub(r"^Drift       0 s .*\n", "", text, flags=re.MULTILINE) for columns, text in texts.items()}
        name = " ".join(command)
        for columns, text in texts.items():
            if words_of(text) != words_of(in_file):
                fault(f"{name}: other words at {columns} columns:\n{text}\nthan:\n{in_file}")
            # A table needs its columns, and a number is not parted from its unit.
            if width_of(text) > min(columns, 120) and (columns > 40 or command[-1] == "--help"):
                fault(f"{name}: {width_of(text)} columns on a screen of {columns}")
        if command[0] != "run" and texts[80] != in_file:
            fault(f"{name}: a file is not like a screen of 80 columns")
        if texts[40].count("\n") <= texts[80].count("\n"):
            fault(f"{name}: a narrow screen does not take more lines")
        if run(*command, COLUMNS="40").stdout.count("\n") <= in_file.count("\n"):
            fault(f"{name}: COLUMNS=40 does not take more lines")
    wide = width_of(on_terminal(200, "--help"))
    if not 100 < wide <= 120:
        fault(f"the help has {wide} columns on a screen of 200")
    usual = run("--help").stdout
    for value in ("", "0", "-40", "wide"):
        if run("--help", COLUMNS=value).stdout != usual:
            fault(f"COLUMNS={value} is not ignored")
    if on_terminal(200, "--help", COLUMNS="80") != usual:
        fault("COLUMNS does not come before the terminal's width")


def check_whole_lines():
    """What editors and shells take line by line is never broken: errors with their places, and commands."""
    with open("faulty.json", "w", encoding="utf-8") as file:
        file.write('{ "site": { "lattitude_deg": 45, "gravity_m_s2": -3 }, "motion": { "duration_s": "long" } }\n')
    whole = run("check", "faulty.json").stderr
    if not whole or any(not re.match(r"faulty\.json:\d+:\d+: (error|warning): ", line) for line in whole.splitlines()):
        fault(f"errors without a place: {whole!r}")
    if run("check", "faulty.json", COLUMNS="40").stderr != whole:
        fault("errors are broken where the screen is narrow")
    for name in verbs():
        narrow = run(name, "--help", COLUMNS="40").stdout
        if [command for command, _ in examples_of(narrow)] != [command for command, _ in examples_of(run(name, "--help").stdout)]:
            fault(f"{name}: commands are broken where the screen is narrow")


def earthtop(*arguments, into=None):
    """Runs a command that must succeed, and keeps what it prints in a file."""
    done = run(*arguments)
    if done.returncode != 0:
        fault(f"earthtop {' '.join(arguments)}: {done.stderr}")
    if into:
        with open(into, "w", encoding="utf-8") as file:
            file.write(done.stdout)


def prepare_scenarios():
    earthtop("example", "toy-top", into="toy-top.json")
    earthtop("example", "lecture-gyro", into="gyro.json")
    with open("toy-top.json", encoding="utf-8") as file:
        text = file.read()
    for name, spin in (("one-way", 200), ("other-way", -200)):
        with open(f"{name}.json", "w", encoding="utf-8") as file:
            file.write(text.replace('"spin_rad_s": 200', f'"spin_rad_s": {spin}'))


def prepare_results():
    """The other files that the examples name."""
    earthtop("run", "toy-top.json", "--out", "old/toy-top", "--quiet")
    earthtop("run", "toy-top.json", "--out", "new/toy-top", "--quiet", "--set", "/release/spin_rad_s=201")
    for name in ("references", "results"):
        shutil.copytree("old", name)
    earthtop("plan", "gyro.json", "--measure", "azimuth_deg", "--sigma", "0.01", "--every", "0.5", "--write-data", "measured.csv",
             "--quiet")
    for name in ("one", "other"):
        earthtop("plan", f"{name}-way.json", "--measure", "azimuth_deg", "--sigma", "0.01", "--every", "0.5", "--write-data", f"{name}.csv",
                 "--quiet")
    with open("latitudes.json", "w", encoding="utf-8") as file:
        file.write('{ "base": "toy-top.json", "axes": [ { "pointer": "/site/latitude_deg", "values": [-30, 0, 30, 60] } ] }\n')
    case = '"criteria": [ { "kind": "invariant", "quantity": "jacobi_integral", "tolerance": 1e-9, "why": "exact" } ], "site"'
    with open("toy-top.json", encoding="utf-8") as file:
        text = file.read().replace('"site"', case, 1)
    os.mkdir("cases")
    for path in ("my-case.json", "cases/case.json"):
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    for part in (1, 2, 3, 4):
        earthtop("study", "latitudes.json", "--shard", f"{part}/4", "--out", f"part{part}", "--quiet")
    earthtop("study", "latitudes.json", "--quiet")


def check_examples(names):
    """Every example ends with status 0, or with the negative answer that is expected of it."""
    paths = [[], *([name] for name in names), ["study", "merge"], ["study", "show"], ["study", "export"]]
    seen = set(NOT_RUN)
    for words in paths:
        for command, _ in examples_of(run(*words, "--help").stdout):
            if command in seen:
                continue
            seen.add(command)
            if command.startswith("earthtop check *.json"):
                os.makedirs("checked", exist_ok=True)
                shutil.copy("toy-top.json", "checked")
                command = "cd checked && " + command
            begin = time.monotonic()
            done = subprocess.run(["bash", "-euo", "pipefail", "-c", command], capture_output=True, text=True, check=False,
                                  stdin=subprocess.DEVNULL, env=environment())
            print(f"{command}: {time.monotonic() - begin:.1f} s", flush=True)
            if done.returncode != STATUS.get(command, 0):
                fault(f"{command}: status {done.returncode}: {done.stderr or done.stdout}")


def main():
    names = verbs()
    if len(names) < 15:
        fault(f"the help lists {names} only")
    prepare_scenarios()
    if "--examples" in sys.argv:
        prepare_results()
        check_examples(names)
    else:
        check_texts(names)
        check_suggestions()
        check_widths(names)
        check_sparkline()
        check_whole_lines()
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        sys.exit(main())
