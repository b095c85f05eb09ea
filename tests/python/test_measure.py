# SPDX-License-Identifier: GPL-3.0-or-later
"""fit, plan and simulated measurements: the program's documents, and what data may be."""

import json
import pickle
import subprocess
import threading

import numpy as np
import pytest

import earthtop as et

pandas = pytest.importorskip("pandas")

VERTICAL = "omega_sin_latitude_rad_s"


@pytest.fixture(scope="module")
def top():
    return et.example("free-gyro").changed(duration_s=60)


@pytest.fixture(scope="module")
def data(top):
    return et.simulate_measurement(top, {"azimuth_arcsec": 20, "tilt_deg": 0.005}, every_s=2, seed=3)


@pytest.fixture
def run(program):
    def run(*arguments):
        command = [program, *map(str, arguments)]
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)

    return run


SETS = ("--set", "/motion/duration_s=60")


def test_simulated_data_are_the_programs(run, scenarios, top, data, tmp_path):
    file = tmp_path / "data.csv"
    run("plan", scenarios / "free-gyro.json", "--measure", "azimuth_arcsec", "--sigma", 20, "--measure", "tilt_deg", "--sigma",
        0.005, "--every", 2, "--write-data", file, "--seed", 3, *SETS)
    theirs = pandas.read_csv(file, comment="#", float_precision="round_trip")
    pandas.testing.assert_frame_equal(data, theirs.astype(float), check_exact=True)
    assert "seed 3" in data.attrs["origin"]
    other = et.simulate_measurement(top, {"azimuth_arcsec": 20, "tilt_deg": 0.005}, every_s=2, seed=4)
    assert (other["azimuth_arcsec"] != data["azimuth_arcsec"]).all()
    short = et.simulate_measurement(top, {"axis_rad": 1e-5}, every_s=0.5, until_s=3, correlation_time_s=2)
    assert short["t_s"].tolist() == [0, 0.5, 1, 1.5, 2, 2.5, 3] and "axis_L_z" in short


def test_tables_as_instruments_write_them(top):
    ball = top.changed({"/release": {"tilt_deg": 0, "spin_rpm": 600}, "/effects": {"viscous_torque_N_m_s": 1e-6}})
    truth = et.simulate_measurement(ball, {"spin_rpm": 0.5}, every_s=10, until_s=60, seed=5)
    table = {"Time (s)": truth["t_s"] + 3.5, "rev/min": truth["spin_rpm"], "room": [20.0] * len(truth)}
    fit = et.fit(ball, table, "effects/viscous_torque_N_m_s", columns={"Time (s)": "t_s", "rev/min": "spin_rpm"},
                 sigma={"spin_rpm": 0.5}, time_offset_s=3.5)
    own = et.fit(ball, truth, "effects/viscous_torque_N_m_s")
    assert fit.agrees and fit.estimates.loc["/effects/viscous_torque_N_m_s", "estimate"] == pytest.approx(
        own.estimates.loc["/effects/viscous_torque_N_m_s", "estimate"], rel=1e-9)
    assert 'column not read: "room"' in fit.document["notes"]
    assert (fit.residuals["quantity"] == "spin").all() and abs(fit.residuals["measured_rad"][0] - 20 * np.pi) < 1  # rad/s
    with pytest.raises(et.ScenarioError, match='the file has no column "rpm"'):
        et.fit(ball, table, columns={"rpm": "spin_rpm"})
    with pytest.raises(et.ScenarioError, match="name each by its column"):
        et.fit(ball, table, sigma="spin_rpm=1")


def test_turning_points_and_passages():
    compass = et.Scenario({"site": {"latitude_deg": 50, "gravity_m_s2": 9.8}, "body": {"mass_kg": 0.5, "center_of_mass_m": [0, 0, 0],
                          "inertia": {"principal_kg_m2": [6e-4, 6e-4, 5e-4]}}, "release": {"tilt_deg": 90, "azimuth_deg": 20, "spin_rad_s": 500},
                           "effects": {"gimbal": {"damping_N_m_s": 2e-6}}, "motion": {"duration_s": 200}})
    data = et.simulate_measurement(compass, {"azimuth_turning_deg": 0.01}, every_s=22.6)
    assert list(data.columns) == ["t_s", "azimuth_turning_deg", "azimuth_turning_se_deg", "extreme"]
    assert data["extreme"].tolist()[:3] == ["max", "min", "max"]
    assert et.fit(compass, data, "release/azimuth_deg").agrees


def test_the_motion_of_a_summary():
    result = et.run(et.example("foucault-pendulum"))
    swing = result.summary["motion"]["swing"]
    assert swing["plane_rate_rad_s"] > 5e-5 and abs(swing["apsidal_rate_rad_s"]) <= swing["apsidal_rate_bound_rad_s"]


@pytest.mark.parametrize("options, flags", [
    (dict(), ()),
    (dict(estimate=VERTICAL), ("--estimate", VERTICAL)),
    (dict(estimate=[VERTICAL, "release/azimuth_deg"], correlation_time_s=3.5),
     ("--estimate", VERTICAL, "--estimate", "/release/azimuth_deg", "--correlation-time", 3.5)),
])
def test_a_fit_is_the_programs(run, scenarios, top, data, tmp_path, options, flags):
    file = tmp_path / "data.csv"
    lines = ["t_s,azimuth_arcsec,azimuth_se_arcsec,tilt_deg,tilt_se_deg"]
    lines += [",".join(map(repr, row)) for row in data.itertuples(index=False)]
    file.write_text("\n".join(lines) + "\n")
    theirs = run("compare", scenarios / "free-gyro.json", file, "--json", *flags, *SETS).stdout
    assert et.fit(top, file, **options).text == theirs
    named = json.loads(theirs)
    assert named.pop("file") == str(file) and named.pop("checksum")
    arrays = {name: data[name].to_numpy() for name in data}
    forms = {"<DataFrame>": data, "<dict>": arrays, "<text>": file.read_text().rstrip("\n")}
    for name, form in forms.items():
        document = dict(et.fit(top, form, **options).document)
        assert document.pop("file") == name and document.pop("checksum")
        assert document == named


def test_a_fit_finds_the_earth_in_noisy_data(top, data):
    rate = 7.292115e-5 * np.sin(np.radians(top["latitude_deg"]))
    still = et.Scenario(top.changed({"earth/rotation_rate_rad_s": 7e-5}).to_dict())
    taken_as_exact = et.fit(still, data, [VERTICAL])
    assert not taken_as_exact.agrees and "contradicts the scenario's 4.949747e-05" in taken_as_exact.sentences[0]
    found = et.fit(still.changed({"uncertainty/rotation_rate_rad_s": 5e-6}), data, [VERTICAL])
    assert found.outcome == "converged" and found.agrees and found.reason == ""
    row = found.estimates.loc[VERTICAL]
    assert row["unit"] == "rad/s" and 0 < row["standard_error"] < 0.05 * rate
    assert abs(row["estimate"] - rate) < 3 * row["standard_error"]
    assert abs(row["start"] - rate) > 3 * row["standard_error"]  # the Earth would not do as it was given
    assert found.sentences[0].startswith("the Earth's rate times sin(latitude)") and VERTICAL not in repr(found.sentences)
    assert found.estimates.loc[VERTICAL, "finding"] == "seen"
    exact = found.exact.set_index("name")
    assert (found.exact["estimate"] == VERTICAL).all() and "center_of_mass_m" in exact.index and VERTICAL not in exact.index
    assert (exact["error_of_one_sigma"] * exact["shift"].abs() / row["standard_error"]).to_numpy() == pytest.approx(1)
    assert found.correlation.loc[VERTICAL, VERTICAL] == 1
    assert found.degrees_of_freedom == 61 and 0.001 < found.p_value < 1
    assert found.chi_squared == pytest.approx((found.residuals["normalised"] ** 2).sum(), rel=1e-12)
    assert found.chi_squared < found.document["chi_squared"]["as_given"]["value"]
    assert found.residuals["quantity"].value_counts().to_dict() == {"azimuth": 31, "tilt": 31}
    again = et.fit(found.fitted_scenario(), data)
    assert again.outcome == "not_asked" and again.estimates.empty
    pandas.testing.assert_frame_equal(again.residuals, found.residuals, check_exact=True)


def test_hints_name_what_would_mend_a_fit(top):
    read_off = top.changed({"instrument/tilt_zero_deg": 0.1})
    fit = et.fit(top, et.simulate_measurement(read_off, {"azimuth_arcsec": 20, "tilt_deg": 0.005}, every_s=2, seed=3), estimate=VERTICAL)
    best = fit.hints[fit.hints["hint"] == 0]
    assert best["name"].tolist() == ["/instrument/tilt_zero_deg"] and best["unit"].tolist() == ["deg"]
    assert abs(best["value"].item() - 0.1) < 4 * best["standard_error"].item()
    assert best["chi_squared"].item() < fit.chi_squared / 10
    mended = et.fit(top, et.simulate_measurement(read_off, {"tilt_deg": 0.005}, every_s=2, seed=3), estimate="/instrument/tilt_zero_deg")
    assert len(mended.hints) == 0 and abs(mended.estimates["estimate"].item() - 0.1) < 0.005


def test_several_releases_are_one_fit(run, scenarios, top, data, tmp_path):
    other = top.changed(azimuth_deg=100)
    more = et.simulate_measurement(other, {"azimuth_arcsec": 20, "tilt_deg": 0.005}, every_s=2, seed=4)
    both = et.fit_releases([(top, data), (other, more)], "release/azimuth_deg", shared=VERTICAL)
    assert both.agrees and list(both.estimates.index) == [VERTICAL, "/release/azimuth_deg of release 1", "/release/azimuth_deg of release 2"]
    assert both.residuals["release"].tolist() == [1] * 62 + [2] * 62
    assert both.correlation.shape == (3, 3) and "of release 2" in both.sentences[2] + both.quotation
    alone = et.fit(top, data, [VERTICAL, "release/azimuth_deg"])
    assert both.estimates.standard_error.iloc[0] < 0.8 * alone.estimates.standard_error.iloc[0]
    plan = et.plan([top, other], {"azimuth_arcsec": 20, "tilt_deg": 0.005}, every_s=2, nuisance="release/azimuth_deg", shared=VERTICAL)
    assert plan.estimates.standard_error.iloc[0] == pytest.approx(both.estimates.standard_error.iloc[0], rel=1e-3)
    assert (plan.releases.standard_error_alone > plan.estimates.standard_error.iloc[0]).all()
    with pytest.raises(et.ScenarioError, match="for several releases"):
        et.fit_releases([(top, data)], shared=VERTICAL)
    with pytest.raises(et.ScenarioError, match="optimise is for one release"):
        et.plan([top, other], {"azimuth_deg": 1}, every_s=2, optimise={"tilt_deg": (5, 60)})


def test_a_free_start_estimates_attitude_and_rates():
    top = et.example("toy-top").changed(duration_s=10)
    film = et.simulate_measurement(top, {"azimuth_deg": 0.01, "tilt_deg": 0.01}, every_s=0.02, seed=5)
    later = film[film.t_s >= 3].copy()
    later["t_s"] -= later["t_s"].iloc[0]
    assert not et.fit(top, later, "tilt_deg").agrees
    fit = et.fit(top, later, "gravity_m_s2", free_start=True)
    assert fit.agrees and fit.estimates.shape[0] == 6
    gravity = fit.estimates.loc["gravity_m_s2"]
    assert abs(gravity.estimate - top["gravity_m_s2"]) < 4 * gravity.standard_error


def test_what_is_not_determined_is_an_outcome(top, data):
    found = et.fit(top, data, ["release/spin_angle_deg"])
    assert found.outcome == "not_determined" and found.reason and not found.agrees
    assert np.isnan(found.estimates["estimate"]).all() and "no fit" in repr(found)
    with pytest.raises(et.ScenarioError, match="no fit"):
        found.fitted_scenario()


def test_priors_enter(run, scenarios, top, data, tmp_path):
    known = top.changed({"uncertainty/spin_rad_s": 0.5, "uncertainty/latitude_deg": 0.1})
    found = et.fit(known, data, ["latitude_deg"], priors=True)
    assert found.document["priors"][0]["input"] == "latitude_deg"
    assert found.estimates.loc["latitude_deg", "standard_error"] < 0.1


def test_frames_may_be_indexed_by_time_and_have_gaps(top, data):
    expected = et.fit(top, data.drop(index=[3]))
    gaps = data.astype(object)
    gaps.loc[3, ["azimuth_arcsec", "tilt_deg"]] = None
    assert et.fit(top, gaps).chi_squared == expected.chi_squared
    nullable = data.convert_dtypes()
    nullable.loc[3, ["azimuth_arcsec", "tilt_deg"]] = pandas.NA
    assert et.fit(top, nullable).chi_squared == expected.chi_squared
    assert et.fit(top, data.drop(index=[3]).set_index("t_s")).chi_squared == expected.chi_squared
    assert et.fit(top, data.drop(index=[3]).assign(_remark="fine, so far")).chi_squared == expected.chi_squared


@pytest.mark.parametrize("change, message", [
    (lambda d: d.rename(columns={"tilt_deg": "tilt_degrees"}), "tilt_degrees.*did you mean"),
    (lambda d: d.drop(columns="tilt_se_deg"), "tilt has no standard error"),
    (lambda d: d.assign(tilt_deg="high"), "<DataFrame>:2:.*not a number"),
    (lambda d: d.assign(tilt_deg=np.inf), "finite"),
    (lambda d: d.assign(tilt_se_deg=0.0), "standard error above 0"),
    (lambda d: d[::-1], "<DataFrame>:3:.*sort the rows"),
    (lambda d: d[:0], "no measured value"),
    (lambda d: d.to_dict("list") | {"t_s": [1.0]}, "different lengths"),
    (lambda d: "", "empty"),
    (lambda d: "missing.csv", "missing.csv"),
    (lambda d: "t_s,tilt_deg,tilt_se_deg\n0,1,1\n1,2\n", "<text>:3:.*2 cells"),
])
def test_bad_data_are_refused(top, data, change, message):
    with pytest.raises(et.ScenarioError, match=message):
        et.fit(top, change(data))


@pytest.mark.parametrize("arguments, message", [
    (dict(estimate="omega_sin_latitude"), "did you mean omega_sin_latitude_rad_s"),
    (dict(estimate=["spin_rad_s", "spin_rad_s"]), "twice"),
    (dict(priors=True), "estimate"),
    (dict(correlation_time_s=-1), "correlation_time_s"),
    (dict(changes={"release/tilt_deg": 200}), "/release/tilt_deg"),
])
def test_bad_arguments_of_a_fit(top, data, arguments, message):
    with pytest.raises(et.ScenarioError, match=message) as caught:
        et.fit(top, data, **arguments)
    assert "--" not in str(caught.value).replace("(from --set)", "")


def test_data_must_be_data(top):
    with pytest.raises(TypeError):
        et.fit(top, 3)


def test_findings_about_changes_are_those_of_the_program(run, scenarios, top, data, tmp_path):
    (tmp_path / "data.csv").write_text("t_s,tilt_deg,tilt_se_deg\n0,1,1\n")
    theirs = run("compare", scenarios / "free-gyro.json", tmp_path / "data.csv", "--set", "/release/tilt_deg=200").stderr
    with pytest.raises(et.ScenarioError) as caught:
        et.fit(et.load(scenarios / "free-gyro.json").changed(tilt_deg=200), data)
    assert [one.text for one in caught.value.findings] == theirs.replace("(from --set)", "(from changes)").splitlines()


def test_a_plan_is_the_programs(run, scenarios, top):
    planned = et.plan(top, {"azimuth_deg": 0.01}, every_s=1, until_s=50, estimate=[VERTICAL], nuisance="release/azimuth_deg",
                      optimise={"tilt_deg": (60, 90)}, correlation_time_s=0.5)
    assert planned.text == run("plan", scenarios / "free-gyro.json", "--measure", "azimuth_deg", "--sigma", 0.01, "--every", 1,
                               "--until", 50, "--estimate", VERTICAL, "--nuisance", "/release/azimuth_deg", "--optimise",
                               "/release/tilt_deg=60:90", "--correlation-time", 0.5, "--json", *SETS).stdout
    assert planned.outcome == "determined" and planned.advice
    assert planned.estimates.loc[VERTICAL, "standard_error"] > planned.estimates.loc[VERTICAL, "standard_error_alone"] > 0
    assert planned.estimates["nuisance"].tolist() == [False, True]
    assert 60 <= planned.best["/release/tilt_deg"] <= 90
    assert et.plan(top.changed(planned.best), {"azimuth_deg": 0.01}, every_s=1, until_s=50, nuisance="release/azimuth_deg",
                   correlation_time_s=0.5).estimates.loc[VERTICAL, "standard_error"] == pytest.approx(
                       planned.document["optimum"]["standard_error"], rel=1e-6)
    assert set(planned.variations["change"]) >= {"duration", "rows", "sigma", "known"}
    assert planned.changes["standard_error"].dtype == float and "<svg" in planned.svg and "sigma" in repr(planned)


def test_a_planned_error_is_that_of_the_fit(top, data):
    planned = et.plan(top, {"azimuth_arcsec": 20, "tilt_deg": 0.005}, every_s=2)
    fitted = et.fit(top, data, VERTICAL)
    assert fitted.estimates.loc[VERTICAL, "standard_error"] == pytest.approx(
        planned.estimates.loc[VERTICAL, "standard_error"], rel=1e-3)
    assert planned.estimates.loc[VERTICAL, "finding"] == "seen"
    shifts = [one.exact.set_index("name")["shift"] for one in (planned, fitted)]
    assert shifts[1][shifts[0].index].to_numpy() == pytest.approx(shifts[0].to_numpy(), rel=0.1)


@pytest.mark.parametrize("arguments, message", [
    (dict(measure={"azimut_deg": 1}), "azimut_deg"),
    (dict(measure={"azimuth_deg": 0}), "above 0"),
    (dict(measure={"azimuth_deg": "small"}), "must be a number"),
    (dict(measure=["azimuth_deg"]), "standard error"),
    (dict(measure={}), "azimuth_deg"),
    (dict(every_s=0), "every_s"),
    (dict(every_s=None), "every_s"),
    (dict(until_s=-1), "until_s"),
    (dict(nuisance="spin"), "did you mean"),
    (dict(optimise={"tilt_deg": 3}), "two limits"),
    (dict(optimise={"tilt_deg": (60, 5)}), "tilt_deg"),
])
def test_bad_plans_are_refused(top, arguments, message):
    with pytest.raises(et.ScenarioError, match=message) as caught:
        et.plan(top, **{"measure": {"azimuth_deg": 0.01}, "every_s": 1, **arguments})
    assert "--" not in str(caught.value)


def test_two_fits_at_once(top, data):
    alone = et.fit(top, data, [VERTICAL, "release/azimuth_deg"]).text
    texts = [[], []]

    def work(i):
        for _ in range(10):
            texts[i].append(et.fit(top, data, [VERTICAL, "release/azimuth_deg"]).text)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert texts == [[alone] * 10] * 2


def test_pictures_pages_and_pickles(program, top, data, tmp_path):
    fitted, planned = et.fit(top, data, VERTICAL), et.plan(top, {"tilt_deg": 0.01}, every_s=5)
    for one in (fitted, planned):
        again = pickle.loads(pickle.dumps(one))
        assert (again.text, again.svg, repr(again)) == (one.text, one.svg, repr(one))
        page = et.report(one, tmp_path / "page.html")
        file = one.save(tmp_path / "document.json", force=True)
        subprocess.run([program, "report", file, "--quiet"], check=True)
        assert page.read_text() == (tmp_path / "document.html").read_text()
        assert 'src="data:image/svg+xml;base64,' in one._repr_html_()
    assert pickle.loads(pickle.dumps(fitted)).fitted_scenario() == fitted.fitted_scenario()
    assert "<svg" in fitted.histogram_svg


@pytest.mark.filterwarnings("default:::matplotlib", "default:::dateutil")
def test_a_fit_is_plotted(top, data):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot

    axes = et.fit(top, data, VERTICAL).plot(color="black")
    assert axes.get_xlabel() == "time / s" and len(axes.containers) == 2
    matplotlib.pyplot.close(axes.figure)
