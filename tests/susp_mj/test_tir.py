"""Reading tyre property files: what the format allows, units, and one line for everything that is wrong."""

from __future__ import annotations

import math

import pytest

from susp_mj.elements.tyres.tir import load_tyre, read_sections
from susp_mj.errors import InputError
from vehicles.reading import FOLDER

SHIPPED = FOLDER / "tyres" / "pac2002_245_40R18.tir"
TEXT = SHIPPED.read_text(encoding="utf-8")


def written(tmp_path, *changes, text=TEXT):
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    path = tmp_path / "mine.tir"
    path.write_text(text, encoding="utf-8")
    return path


def error_of(tmp_path, *changes):
    with pytest.raises(InputError) as caught:
        load_tyre(written(tmp_path, *changes))
    text = str(caught.value)
    assert text.startswith("mine.tir: ")
    assert "\n" not in text
    return text


@pytest.mark.parametrize("path", sorted((FOLDER / "tyres").glob("*.tir")), ids=lambda each: each.stem)
def test_shipped_tyres_load_and_name_their_source(path):
    tyre = load_tyre(path)
    assert all(math.isfinite(value) for value in tyre.parameters())
    assert "cited:" in path.read_text(encoding="utf-8")
    assert math.isfinite(sum(tyre.evaluate(0.02, 0.03, 0.01, 3000.0)))


def test_every_coefficient_arrives():
    tyre = load_tyre(SHIPPED)
    sections = read_sections(SHIPPED)
    for name in ("longitudinal", "lateral", "aligning", "rolling", "scaling"):
        there = {
            key: float(text)
            for key, text in sections[f"{name.upper()}_COEFFICIENTS"].items()
            if key not in ("LGYR", "QTZ1", "MBELT")
        }
        found = getattr(tyre, name).model_dump()
        assert there == {key: found[key] for key in there}
        assert there
    assert (tyre.radius, tyre.model.TYRESIDE, tyre.model.USE_MODE, tyre.ranges.KPUMIN) == (0.344, "LEFT", 4, -1.5)


def test_comments_quotes_case_and_tables(tmp_path):
    noise = "$--- a line = of dashes\n! PCX1 = 9\n[shape]\n{radial width}\n 1.0 0.0\n 0.9 1.0\n"
    noise += "[LONGITUDINAL_COEFFICIENTS]\npcx1=+1.6411D0$ inline"
    path = written(
        tmp_path,
        ("[LONGITUDINAL_COEFFICIENTS]\nPCX1 = 1.6411", noise),
        ("'LEFT'", '"Left"  $ side'),
        ("= 'PAC2002'", "='PAC2002'"),
    )
    assert load_tyre(path) == load_tyre(SHIPPED)
    assert read_sections(written(tmp_path, text="[A]\nNOTE = 'five $ or ! more' $ price\n"))["A"] == {
        "NOTE": "five $ or ! more"
    }


def test_windows_lines_and_byte_order_mark(tmp_path):
    path = tmp_path / "mine.tir"
    path.write_bytes(b"\xef\xbb\xbf" + TEXT.replace("\n", "\r\n").encode())
    assert load_tyre(path) == load_tyre(SHIPPED)


def test_units(tmp_path):
    """The same tyre in millimetre, kilonewton, degree and millisecond."""
    there = load_tyre(SHIPPED)
    path = written(
        tmp_path,
        ("'meter'", "'mm'"),
        ("'newton'", "'kilonewton'"),
        ("'radian'", "'degree'"),
        ("'second'", "'millisecond'"),
        ("LONGVL = 16.6", "LONGVL = 16.6"),
        ("UNLOADED_RADIUS = 0.344", "UNLOADED_RADIUS = 344"),
        ("VERTICAL_STIFFNESS = 280835.2941", "VERTICAL_STIFFNESS = 0.2808352941"),
        ("VERTICAL_DAMPING = 2000.0", "VERTICAL_DAMPING = 2.0"),
        ("FNOMIN = 4850.0", "FNOMIN = 4.85"),
        ("FZMAX = 10125.0", "FZMAX = 10.125"),
        ("ALPMAX = 1.5708", "ALPMAX = 90"),
        ("ALPMIN = -1.5708", "ALPMIN = -90"),
    )
    tyre = load_tyre(path)
    assert (tyre.radius, tyre.vertical.FNOMIN, tyre.ranges.FZMAX) == pytest.approx((0.344, 4850, 10125), rel=1e-12)
    assert pytest.approx(there.vertical_stiffness, rel=1e-12) == tyre.vertical_stiffness
    assert pytest.approx(there.vertical_damping, rel=1e-12) == tyre.vertical_damping
    assert pytest.approx(16.6, rel=1e-12) == tyre.model.LONGVL
    assert pytest.approx(math.pi / 2, rel=1e-12) == tyre.ranges.ALPMAX
    assert tyre.lateral == there.lateral, "coefficients are those of the formula in radians"


@pytest.mark.parametrize(("mode", "expected"), [("3", 3), ("4", 4), ("14", 4), ("23", 3)])
def test_use_mode_may_carry_its_transients(tmp_path, mode, expected):
    assert expected == load_tyre(written(tmp_path, ("USE_MODE = 4", f"USE_MODE = {mode}"))).model.USE_MODE


def test_uncombined_needs_no_weights(tmp_path):
    assert load_tyre(written(tmp_path, ("USE_MODE = 4", "USE_MODE = 3"), ("RBX1 = 11.0", ""))).longitudinal.RBX1 is None


@pytest.mark.parametrize("fit", ["6", "21", "52"])
def test_fit_types_of_52(tmp_path, fit):
    assert load_tyre(
        written(tmp_path, ("PROPERTY_FILE_FORMAT = 'PAC2002'", f"PROPERTY_FILE_FORMAT='USER'\nFITTYP = {fit}"))
    )


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        (
            "PROPERTY_FILE_FORMAT",
            "FITTYP = 63\nPROPERTY_FILE_FORMAT",
            ("MODEL.FITTYP", "'63' is not supported", "6 (MF 5.2)", "61 (MF 6.1)"),
        ),
        ("'PAC2002'", "'PAC_MC'", ("MODEL.PROPERTY_FILE_FORMAT", "'PAC_MC' is not supported", "PAC2002")),
        ("PROPERTY_FILE_FORMAT = 'PAC2002'", "", ("MODEL.PROPERTY_FILE_FORMAT", "is required", "PAC2002")),
        ("'PAC2002'", "'USER'", ("MODEL.FITTYP", "is required")),
        ("PKY1 = -21.92", "", ("LATERAL_COEFFICIENTS.PKY1", "is required")),
        ("PKY1 = -21.92", "PKY1 = 21.92", ("LATERAL_COEFFICIENTS.PKY1", "21.92", "less than 0")),
        ("RCY1 = 1.0", "", ("LATERAL_COEFFICIENTS.RCY1", "USE_MODE 4")),
        ("PCX1 = 1.6411", "PCX1 = 1,6411", ("LONGITUDINAL_COEFFICIENTS.PCX1", "'1,6411' is not a number")),
        (
            "PCX1 = 1.6411",
            "PCX1 = 1.6411\nPPX1 = 0.3",
            ("LONGITUDINAL_COEFFICIENTS.PPX1", "unknown coefficient", "choose"),
        ),
        ("LFZO = 0.81", "LFZO = 0.81\nLFZ0 = 0.9", ("SCALING_COEFFICIENTS.LFZ0", "did you mean")),
        ("LMUY = 1.0", "LMUY = 0", ("SCALING_COEFFICIENTS.LMUY", "greater than 0")),
        ("PCX1 = 1.6411", "PCX1 = 1.6411\nPCX1 = 1.7", ("LONGITUDINAL_COEFFICIENTS.PCX1", "second time")),
        ("'meter'", "'furlong'", ("UNITS.LENGTH", "'furlong' unknown", "mm")),
        ("LENGTH =", "LENGHT =", ("UNITS.LENGHT", "did you mean 'LENGTH'")),
        ("UNLOADED_RADIUS = 0.344", "", ("DIMENSION.UNLOADED_RADIUS", "is required")),
        ("ALPMAX = 1.5708", "ALPMAX = 2", ("SLIP_ANGLE_RANGE.ALPMAX", "2", "at most")),
        ("FZMAX = 10125.0", "", ("VERTICAL_FORCE_RANGE.FZMAX", "is required")),
        ("'LEFT'", "'MIDDLE'", ("MODEL.TYRESIDE", "MIDDLE", "RIGHT")),
        ("USE_MODE = 4", "USE_MODE = 2", ("MODEL.USE_MODE", "2", "3 or 4")),
        ("[UNITS]", "X = 1\n[UNITS]", ("X", "before the first [SECTION]")),
    ],
)
def test_errors_name_file_key_value_and_choices(tmp_path, old, new, parts):
    text = error_of(tmp_path, (old, new))
    for part in parts:
        assert part in text


# ---- MF 6.1

SHIPPED_61 = FOLDER / "tyres" / "mf61_205_60R15.tir"
TEXT_61 = SHIPPED_61.read_text(encoding="utf-8")


def test_every_coefficient_of_61_arrives():
    tyre = load_tyre(SHIPPED_61)
    sections = read_sections(SHIPPED_61)
    for section, name in (
        ("STRUCTURAL", "structure"),
        ("OPERATING_CONDITIONS", "operation"),
        ("INFLATION_PRESSURE_RANGE", "ranges"),
    ):
        for key, text in sections[section].items():
            assert getattr(getattr(tyre, name), key) == float(text)
    for name in ("longitudinal", "lateral", "aligning", "overturning", "rolling"):
        there = {key: float(text) for key, text in sections[f"{name.upper()}_COEFFICIENTS"].items()}
        found = getattr(tyre, name).model_dump()
        assert there == {key: found[key] for key in there}
        assert len(there) > 6
    assert tyre.kind == "magic_formula_61"
    assert (tyre.radius, tyre.vertical_stiffness, tyre.vertical.Q_FZ2) == (0.3135, 209651, 15.4)


@pytest.mark.parametrize("fit", ["61", "62"])
@pytest.mark.parametrize("form", ["", "PROPERTY_FILE_FORMAT = 'MF-TYRE'\n"])
def test_fit_types_of_61(tmp_path, fit, form):
    path = written(tmp_path, ("FITTYP = 61", f"{form}FITTYP = {fit}"), text=TEXT_61)
    assert load_tyre(path) == load_tyre(SHIPPED_61)


def test_units_of_61(tmp_path):
    """Pressures and the stiffness of the carcass follow [UNITS]."""
    there = load_tyre(SHIPPED_61)
    changes = [
        ("'pascal'", "'bar'"),
        ("'meter'", "'mm'"),
        ("UNLOADED_RADIUS = 0.3135", "UNLOADED_RADIUS = 313.5"),
        ("LONGVL = 16.7", "LONGVL = 16700"),
        ("VERTICAL_STIFFNESS = 209651", "VERTICAL_STIFFNESS = 209.651"),
        ("VERTICAL_DAMPING = 500", "VERTICAL_DAMPING = 0.5"),
        ("LONGITUDINAL_STIFFNESS = 358000", "LONGITUDINAL_STIFFNESS = 358"),
        ("LATERAL_STIFFNESS = 103000", "LATERAL_STIFFNESS = 103"),
        ("INFLPRES = 220000", "INFLPRES = 2.2"),
        ("NOMPRES = 220000", "NOMPRES = 2.2"),
        ("PRESMIN = 180000", "PRESMIN = 1.8"),
        ("PRESMAX = 300000", "PRESMAX = 3"),
    ]
    tyre = load_tyre(written(tmp_path, *changes, text=TEXT_61))
    assert tyre.parameters() == pytest.approx(there.parameters(), rel=1e-12)
    assert pytest.approx((220000, 300000), rel=1e-12) == (tyre.operation.NOMPRES, tyre.ranges.PRESMAX)
    assert tyre.vertical_stiffness == pytest.approx(there.vertical_stiffness, rel=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ("NOMPRES = 220000", "", ("OPERATING_CONDITIONS.NOMPRES", "is required")),
        ("[OPERATING_CONDITIONS]\nINFLPRES = 220000\nNOMPRES = 220000", "", ("OPERATING_CONDITIONS", "is required")),
        ("LATERAL_STIFFNESS = 103000", "", ("STRUCTURAL.LATERAL_STIFFNESS", "is required")),
        ("PKY6 = -0.8987", "", ("LATERAL_COEFFICIENTS.PKY6", "is required")),
        (
            "PKY6 = -0.8987",
            "PKY6 = -0.8987\nPHY3 = 0.1",
            ("LATERAL_COEFFICIENTS.PHY3", "unknown coefficient of MF 6.1"),
        ),
        ("VERTICAL_STIFFNESS = 209651", "", ("VERTICAL.VERTICAL_STIFFNESS", "is required")),
        ("INFLPRES = 220000", "INFLPRES = 120000", ("OPERATING_CONDITIONS.INFLPRES", "120000 Pa", "180000 to 300000")),
        ("PRESMAX = 300000", "PRESMAX = -3", ("INFLATION_PRESSURE_RANGE.PRESMAX", "greater than 0")),
        ("RBY1 = 10.622", "", ("LATERAL_COEFFICIENTS.RBY1", "USE_MODE 4")),
        ("FITTYP = 61", "FITTYP = 7", ("MODEL.FITTYP", "'7' is not supported", "61 (MF 6.1), 62 (MF 6.1)")),
    ],
)
def test_errors_of_61(tmp_path, old, new, parts):
    with pytest.raises(InputError) as caught:
        load_tyre(written(tmp_path, (old, new), text=TEXT_61))
    for part in ("mine.tir: ", *parts):
        assert part in str(caught.value)


def test_what_61_does_without_passes(tmp_path):
    extra = "PCX1 = 1.579\nPTX1 = 1.98\n"
    path = written(
        tmp_path,
        ("PCX1 = 1.579\n", extra),
        ("[LATERAL_C", "[SCALING_COEFFICIENTS]\nLGAX = 1\nLMUV = 0\n[LATERAL_C"),
        text=TEXT_61,
    )
    assert load_tyre(path) == load_tyre(SHIPPED_61)


def test_pressure_of_the_caller():
    assert load_tyre(SHIPPED_61, inflation_pressure=250000.0).operation.INFLPRES == 250000.0
    with pytest.raises(InputError, match=r"pac2002_245_40R18.tir: inflation_pressure: MF 5.2 does not depend on it"):
        load_tyre(SHIPPED, inflation_pressure=250000.0)


def test_missing_file(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        load_tyre(tmp_path / "none.tir")


def test_neutral_coefficients_of_other_versions_pass(tmp_path):
    assert load_tyre(
        written(tmp_path, ("PCX1 = 1.6411", "PCX1 = 1.6411\nPPX1 = 0.0"), ("LFZO = 0.81", "LFZO = 0.81\nLKZC = 1"))
    )
