"""`--dialect`, and the dialect that a folder says itself: `check` and `run`."""

from pathlib import Path

from scanbench.syntax.language_file import LANGUAGE_FILE, language_text
from tests.cli.calling import scanbench

WORDS = "PROGRAM Main\nVAR w : WORD := 65535; d : DWORD; END_VAR\nd := w + 1;\nEND_PROGRAM\n"
TWINCAT = (
    '<TcPlcObject><POU Name="Main"><Declaration><![CDATA[PROGRAM Main\nVAR w : WORD; END_VAR]]></Declaration>'
    "<Implementation><ST><![CDATA[w := w + 1;]]></ST></Implementation></POU></TcPlcObject>"
)


def test_a_dialect_is_named_for_a_file_and_for_a_folder(tmp_path: Path) -> None:
    (tmp_path / "Main.st").write_text(WORDS)
    for path in (tmp_path, tmp_path / "Main.st"):
        strict = scanbench("check", str(path))
        assert (strict.returncode, strict.stdout.count("T002")) == (1, 1)
        named = scanbench("check", str(path), "--dialect", "CODESYS")
        assert (named.returncode, named.stdout.count("W006 warning")) == (0, 1)
        ran = scanbench("run", str(path), "--scans", "1", "--dialect", "codesys", "--print", "Main.d")
        assert (ran.returncode, "16#00010000" in ran.stdout) == (0, True), ran


def test_a_folder_says_its_dialect_and_the_command_line_goes_before_it(tmp_path: Path) -> None:
    (tmp_path / "Main.st").write_text(WORDS)
    (tmp_path / LANGUAGE_FILE).write_text(language_text("twincat"))
    assert scanbench("check", str(tmp_path)).returncode == 0
    assert scanbench("check", str(tmp_path), "--dialect", "iec").returncode == 1


def test_an_unknown_dialect_is_told_with_those_that_there_are(tmp_path: Path) -> None:
    (tmp_path / "Main.st").write_text(WORDS)
    said = scanbench("check", str(tmp_path), "--dialect", "basic")
    assert said.returncode == 2
    assert "there is no dialect basic: write one of iec, codesys" in said.stderr


def test_the_format_of_files_names_the_dialect_and_the_command_line_goes_before_it(tmp_path: Path) -> None:
    (tmp_path / "Main.TcPOU").write_text(TWINCAT)
    said = scanbench("check", str(tmp_path))
    assert (said.returncode, "twincat programs by the format" in said.stderr) == (0, True), said
    assert scanbench("check", str(tmp_path), "--dialect", "iec").returncode == 1
    assert "by the format" not in scanbench("check", str(tmp_path), "--dialect", "twincat").stderr


def test_the_likely_dialect_of_text_is_named(tmp_path: Path) -> None:
    (tmp_path / "Main.st").write_text("{attribute 'qualified_only'}\nVAR_GLOBAL g : INT; END_VAR\n" + WORDS)
    said = scanbench("check", str(tmp_path))
    assert (said.returncode, said.stdout.count("T002")) == (1, 1)
    assert "--dialect codesys" in said.stderr


def test_a_recorded_run_is_replayed_in_its_dialect(tmp_path: Path) -> None:
    (tmp_path / "Main.st").write_text(WORDS)
    run = tmp_path / "kept.run"
    ran = scanbench(
        "run", str(tmp_path / "Main.st"), "--scans", "3", "--dialect", "codesys", "--record", str(run), "--hash"
    )
    assert ran.returncode == 0, ran
    again = scanbench("replay", str(run))
    assert again.returncode == 0, again


def test_a_package_of_simatic_ax_names_the_dialect(tmp_path: Path) -> None:
    source = tmp_path / "src"
    source.mkdir()
    (source / "Main.st").write_text("PROGRAM Main VAR n : INT; END_VAR n += 1; END_PROGRAM\n")
    assert scanbench("check", str(tmp_path)).returncode == 1
    (tmp_path / "apax.yml").write_text("name: plant\n")
    said = scanbench("check", str(tmp_path))
    assert (said.returncode, "siemens programs by the format" in said.stderr) == (0, True), said
    ran = scanbench("run", str(tmp_path), "--scans", "1", "--print", "Main.n")
    assert (ran.returncode, "siemens programs by the format" in ran.stderr) == (0, True), ran
    assert scanbench("check", str(tmp_path), "--dialect", "iec").returncode == 1
    (tmp_path / LANGUAGE_FILE).write_text(language_text("iec"))
    assert scanbench("check", str(tmp_path)).returncode == 1
