#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies that grow, and what comes out of their stores, as a user sees it: killed while they grow; the SQL of the manual; JSON; lists of
quantities; labels and quantiles.
usage: growth_test.py PATH_OF_EARTHTOP [names of tests]
"""
import csv
import json
import os
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = os.path.abspath(sys.argv[1])
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BASE = {"name": "a-top", "site": {"latitude_deg": 45, "gravity_m_s2": 9.8},
        "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                 "inertia": {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
        "release": {"tilt_deg": 20, "spin_rad_s": 200}, "motion": {"duration_s": 1}}


def latitudes(points, low=-80, high=80):
    return {"pointer": "/site/latitude_deg", "range": {"from": low, "to": high, "points": points}}


def tilts(values):
    return {"pointer": "/release/tilt_deg", "values": values}


class Studies(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.directory)

    def path(self, *names):
        return os.path.join(self.directory, *names)

    def text(self, *names):
        with open(self.path(*names), encoding="utf-8") as file:
            return file.read()

    def write(self, name, **parts):
        with open(self.path(name + ".json"), "w", encoding="utf-8") as file:
            json.dump({"name": "grown", "base": BASE, **parts}, file)
        return name + ".json"

    def contents(self, directory):
        found = {}
        for name in os.listdir(self.path(directory)):
            with open(self.path(directory, name), "rb") as file:
                found[name] = file.read()
        return found

    def run_program(self, *arguments, status=0):
        done = subprocess.run([PROGRAM, *arguments], cwd=self.directory, capture_output=True, text=True, check=False, timeout=600)
        self.assertEqual(done.returncode, status, done.stderr + done.stdout)
        return done

    def same_results(self, one, other):
        for name in ("study.csv", "study.json"):
            self.assertTrue(self.text(one, name) == self.text(other, name), f"{name} of {one} and {other} differ")


class Growing(Studies):
    def test_killed_while_it_grows_it_goes_on_and_is_the_same(self):
        old = self.write("old", axes=[latitudes(101), tilts([10, 20])])
        new = self.write("new", axes=[latitudes(201), tilts([10, 15, 20])])
        self.run_program("study", new, "--out", "fresh", "--quiet")
        self.run_program("study", old, "--out", "once", "--quiet")
        moments = random.Random(20261128)
        kills, known = 0, 0
        for turn in range(4):
            shutil.rmtree(self.path("grown"), ignore_errors=True)
            shutil.copytree(self.path("once"), self.path("grown"))
            for _ in range(8):
                child = subprocess.Popen([PROGRAM, "study", new, "--out", "grown", "--quiet", "--jobs", "1"], cwd=self.directory,
                                         stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                time.sleep(moments.uniform(0.005, 0.6))
                child.send_signal(signal.SIGKILL)
                kills += child.wait() == -signal.SIGKILL
                with sqlite3.connect(self.path("grown", "study.sqlite")) as store:
                    points = store.execute("SELECT count(*) FROM point").fetchone()[0]
                store.close()
                self.assertGreaterEqual(points, 202, "what was there before has been lost")
                known = max(known, points)
            done = self.run_program("study", new, "--out", "grown")
            self.assertRegex(done.stderr, r"reused 202 of 603 points|resuming: \d+ of 603|^$")
            self.same_results("grown", "fresh")
            left = [name for name in os.listdir(self.path("grown")) if not re.fullmatch(r"study\.(csv|json|sqlite|svg)", name)]
            self.assertEqual(left, [], f"left behind in turn {turn}")
        print(f"{kills} kills, up to {known} points before one")
        self.assertGreater(kills, 8)

    def test_it_says_what_it_reuses(self):
        self.run_program("study", self.write("old", axes=[latitudes(5)]), "--out", "a", "--quiet")
        done = self.run_program("study", self.write("new", axes=[latitudes(9)]), "--out", "a")
        self.assertIn("reused 5 of 9 points from a/study.sqlite", done.stderr)
        self.assertNotIn("resuming", done.stderr)
        collect = ["drift.axis_final_rad", "drift.spin_final_rad"]
        done = self.run_program("study", self.write("more", axes=[latitudes(9)], collect=collect), "--out", "a")
        self.assertIn("reused 0 of 9 points from a/study.sqlite: drift.spin_final_rad was not collected, so every point is computed "
                      "again", done.stderr)
        self.assertEqual(self.run_program("study", "more.json", "--out", "a", "--quiet").stderr, "")

    def test_what_would_be_lost_is_refused_with_its_number_and_the_remedy(self):
        self.run_program("study", self.write("old", axes=[tilts([10, 20, 30])]), "--out", "a", "--quiet")
        before = self.contents("a")
        new = self.write("new", axes=[tilts([20, 30, 40, 50])])
        done = self.run_program("study", new, "--out", "a", status=2)
        for words in ("holds 3 points of another study or another design; this one lacks 1 of them", "/axes/0/values/0: 10 there, 20 here", "would be lost",
                      "--reuse a/study.sqlite", "--force"):
            self.assertIn(words, done.stderr)
        self.assertEqual(before, self.contents("a"))
        done = self.run_program("study", new, "--out", "b", "--reuse", "a")
        self.assertIn("reused 2 of 4 points from a/study.sqlite; 1 of its 3 points are not in this design, and stay there", done.stderr)
        done = self.run_program("study", new, "--out", "a", "--force")
        self.assertIn("1 of its 3 points are not in this design, and have been dropped", done.stderr)
        self.same_results("a", "b")
        self.run_program("study", new, "--out", "c", "--quiet")
        self.same_results("a", "c")

    def test_a_merger_of_unlike_designs(self):
        for name, axis in (("a", tilts([10, 30])), ("b", tilts([20, 30])), ("c", tilts([10, 20, 30]))):
            self.run_program("study", self.write(name, axes=[axis]), "--out", name, "--quiet")
        self.run_program("study", "merge", "a", "b", "--out", "m", "--quiet")
        self.assertEqual(self.text("m", "study.csv"), self.text("c", "study.csv"))
        self.run_program("study", "merge", "a", "c", "--out", "n", "--quiet")
        self.assertEqual(self.text("n", "study.csv"), self.text("c", "study.csv"))
        other = self.write("other", axes=[tilts([10, 30])], set={"/release/spin_rad_s": 150})
        self.run_program("study", other, "--out", "d", "--quiet")
        done = self.run_program("study", "merge", "a", "d", "--out", "o", status=2)
        self.assertIn("/set/release/spin_rad_s: 150 there, none here", done.stderr)
        self.assertFalse(os.path.exists(self.path("o")))


class OutOfTheStore(Studies):
    def manual_query(self):
        with open(os.path.join(ROOT, "tools", "README.md"), encoding="utf-8") as file:
            section = file.read().split("### The store")[1]
        return re.search(r'execute\("""(.*?)"""\)', section, re.DOTALL).group(1)

    def test_the_sql_of_the_manual_gives_what_study_csv_has(self):
        study = self.write("s", axes=[latitudes(5), {"pointer": "/release/spin_rad_s", "name": "top", "values": [200, 300]}],
                           collect=["drift.axis_final_rad", "drift.verdict"])
        self.run_program("study", study, "--out", "a", "--quiet")
        store = sqlite3.connect(f"file:{self.path('a', 'study.sqlite')}?mode=ro", uri=True)
        self.addCleanup(store.close)
        with open(self.path("a", "study.csv"), encoding="utf-8", newline="") as file:
            table = list(csv.DictReader(file))
        wanted = [(float(row["latitude_deg"]), float(row["drift.axis_final_rad"])) for row in table if row["top"] == "300"]
        self.assertEqual(store.execute(self.manual_query()).fetchall(), wanted[:2])
        every = store.execute('SELECT number, latitude_deg, top, "drift.axis_final_rad", "drift.verdict", status FROM point '
                              "ORDER BY number").fetchall()
        self.assertEqual(every, [(int(r["point"]), float(r["latitude_deg"]), float(r["top"]), float(r["drift.axis_final_rad"]),
                                  r["drift.verdict"], r["status"]) for r in table])

    def test_the_manual_names_every_table_and_column(self):
        self.run_program("study", self.write("s", axes=[latitudes(2)]), "--out", "a", "--quiet")
        with open(os.path.join(ROOT, "tools", "README.md"), encoding="utf-8") as file:
            section = file.read().split("### The store")[1].split("###")[0]
        store = sqlite3.connect(self.path("a", "study.sqlite"))
        self.addCleanup(store.close)
        tables = [name for name, in store.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        self.assertEqual(sorted(tables), ["point", "study"])
        columns = [row[1] for row in store.execute("PRAGMA table_info(point)")]
        for name in ("number", "status", "reason", "scenario_sha256", "row_checksum"):
            self.assertIn(name, columns)
            self.assertIn(f"`{name}`", section)
        kept = {"facts_checksum", "contents", "grown_from", "mixed_builds"}  # what the program keeps for itself
        for key, in store.execute("SELECT key FROM study"):
            self.assertTrue(key in kept or f"`{key}`" in section, key)

    def test_all_points_as_a_json_document_that_fits_its_schema(self):
        study = self.write("s", axes=[latitudes(1201, -100, 80)], collect=["drift.axis_final_rad", "drift.verdict"])
        self.run_program("study", study, "--out", "a", "--quiet", status=1)
        document = json.loads(self.run_program("study", "export", "a", "--json").stdout)
        with open(self.path("a", "study.csv"), encoding="utf-8", newline="") as file:
            table = list(csv.DictReader(file))
        self.assertEqual(len(document["points"]), 1201)
        for point, row in zip(document["points"], table):
            number = point["drift.axis_final_rad"]
            self.assertEqual((str(point["point"]), point["status"], point.get("reason", ""), point["latitude_deg"]),
                             (row["point"], row["status"], row["reason"], float(row["latitude_deg"])))
            self.assertEqual(number, float(row["drift.axis_final_rad"]) if row["drift.axis_final_rad"] else None)
        known = json.loads(self.text("a", "study.json"))
        self.assertIsNone(known["points"])
        for key in known:
            if key not in ("points", "files", "checksum"):
                self.assertEqual(document[key], known[key], key)
        schema = json.loads(self.run_program("schema", "--study-results").stdout)
        for one in (document, known):
            self.assertLessEqual(set(schema["required"]), set(one))
            self.assertLessEqual(set(one), set(schema["properties"]))
        try:
            import jsonschema
        except ImportError:
            return
        for one in (document, known):
            jsonschema.validate(one, schema)

    def test_every_listed_quantity_can_be_collected(self):
        listed = json.loads(self.run_program("study", "--list-quantities", "--json").stdout)["quantities"]
        paths = [each["path"] for each in listed]
        self.assertEqual(len(paths), len(set(paths)))
        self.assertEqual([each["path"] for each in listed if not each["meaning"]], [])
        units = {each["path"]: each["unit"] for each in listed}
        for path, unit in (("drift.axis_final_rad", "rad"), ("motion.axis_final_L.0", ""), ("top.mass_kg", "kg"),
                           ("scenario.release.tilt_deg", "deg"), ("top.rim_speed_m_s", "m/s"), ("stops.0.t_s", "s")):
            self.assertEqual(units[path], unit, path)
        for begin in range(0, len(paths), 190):
            self.run_program("study", self.write("s", axes=[latitudes(2)], collect=paths[begin:begin + 190]), "--dry-run")
        lines = self.run_program("study", "--list-quantities").stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines], paths)

    def test_the_list_of_a_study_has_what_its_runs_have(self):
        study = self.write("s", axes=[latitudes(2)])
        listed = [each["path"] for each in json.loads(self.run_program("study", study, "--list-quantities", "--json").stdout)["quantities"]]
        for path in ("drift.axis_final_rad", "motion.axis_final_L.2", "scenario.release.spin_rad_s"):
            self.assertIn(path, listed)
        for path in ("contact.events.0.t_s", "rotor.angle_final_rad", "gimbal_events.0.t_s", "drift.threshold_time_s"):
            self.assertNotIn(path, listed)
        with open(self.path("base.json"), "w", encoding="utf-8") as file:
            json.dump({**BASE, "report": {"threshold_rad": 1e-3}}, file)
        self.assertIn("drift.threshold_time_s", self.run_program("study", "base.json", "--list-quantities").stdout)
        self.run_program("study", "none.json", "--list-quantities", status=2)

    def test_names_with_numbers_and_capitals_need_no_alias(self):
        study = self.write("s", axes=[latitudes(2)], collect=["motion.axis_final_L.0", "motion.axis_final_L.2"])
        self.run_program("study", study, "--out", "a", "--quiet")
        self.assertEqual(self.text("a", "study.csv").splitlines()[0],
                         "point,latitude_deg,motion.axis_final_L.0,motion.axis_final_L.2,status,reason")
        twice = self.write("t", axes=[latitudes(2)], collect=[{"name": "A", "path": "drift.verdict"}, {"name": "a", "path": "drift.verdict"}])
        self.assertIn("there is already a column", self.run_program("study", twice, status=2).stderr)


class Shown(Studies):
    def test_labels_have_the_digits_that_were_meant(self):
        meant = ["-0.3", "-0.2", "-0.1", "0", "0.1", "0.2", "0.3"]
        axes = [{"pointer": "/release/tilt_deg", "range": {"from": 0.1, "to": 0.7, "points": 7}}, latitudes(7, -0.3, 0.3)]
        done = self.run_program("study", self.write("s", axes=axes), "--out", "a")
        self.run_program("report", "a")
        self.assertEqual(re.search(r"tilt_deg \\ latitude_deg +(.*)", done.stdout).group(1).split(), meant)
        marginals = json.loads(self.text("a", "study.json"))["marginals"]
        self.assertEqual([row["value"] for row in marginals["latitude_deg"]], meant)
        self.assertEqual([row["value"] for row in marginals["tilt_deg"]], ["0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"])
        page = self.text("a", "report.html")
        self.assertIn('"values":[-0.3,-0.2,-0.1,0.0,0.1,0.2,0.3]', page)
        for file in ("report.html", "study.svg"):
            self.assertNotRegex(self.text("a", file), r"latitude_deg [-0-9.]{8}")
        self.assertEqual(set(re.findall(r"latitude (-?[0-9.]+)°<", self.text("a", "study.svg"))), set(meant))
        # Levels that differ in the seventh digit are told apart; thirds stay thirds.
        done = self.run_program("study", self.write("t", axes=[latitudes(2), {"pointer": "/release/tilt_deg", "values": [10.0000001, 10.0000002]}]),
                                "--out", "b")
        self.assertIn("10.0000001", done.stdout)
        self.assertIn("10.0000002", done.stdout)

    def test_quantiles_stand_beside_means(self):
        axes = [latitudes(21), tilts([10, 20, 30]), {"pointer": "/release/spin_rad_s", "values": [150, 200]}]
        done = self.run_program("study", self.write("s", axes=axes, collect=["drift.azimuth_final_rad"]), "--out", "a")
        document = json.loads(self.text("a", "study.json"))
        with open(self.path("a", "study.csv"), encoding="utf-8", newline="") as file:
            table = list(csv.DictReader(file))
        for row in document["marginals"]["tilt_deg"]:
            numbers = sorted(float(r["drift.azimuth_final_rad"]) for r in table if float(r["tilt_deg"]) == float(row["value"]))
            of = row["drift.azimuth_final_rad"]
            self.assertEqual(of["count"], 42)
            self.assertEqual((of["quantile_05"], of["median"], of["quantile_95"]), (numbers[2], numbers[21], numbers[39]))
        self.assertIn("Means and quantiles of drift.azimuth_final_rad along tilt_deg", done.stdout)
        shown = re.search(r"along tilt_deg\n(.*)\n(.*)", done.stdout)
        self.assertEqual(shown.group(1).split(), ["tilt_deg", "count", "mean", "5", "%", "median", "95", "%"])
        first = document["marginals"]["tilt_deg"][0]["drift.azimuth_final_rad"]
        wanted = ["10", "42"] + [f"{first[key]:.6g}" for key in ("mean", "quantile_05", "median", "quantile_95")]
        self.assertEqual(shown.group(2).split(), wanted)
        self.assertEqual(self.run_program("study", "show", "a").stdout.strip(), done.stdout.split("\nResults in")[0].strip())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
