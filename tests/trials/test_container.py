"""What the trial of the container takes from the Containerfile."""

from tests.trials import container


def test_continued_lines_are_one_instruction_and_comments_none():
    text = "# a comment\nFROM base\nRUN one \\\n # inside\n && two\nWORKDIR /work\n"
    assert container.instructions(text) == {
        "FROM": "base",
        "RUN": "one   && two",
        "WORKDIR": "/work",
    }


def test_the_steps_are_those_of_the_file():
    about = container.instructions(container.FILE.read_text("utf-8"))
    assert about["COPY"].endswith(f"/{container.PROJECT}")
    assert f"/{container.PROJECT}/tools/setup.sh" in about["RUN"]
    assert about["ENTRYPOINT"].startswith(f'["/{container.PROJECT}/.venv/bin/snakemake"')
    assert about["WORKDIR"] == "/work"
    apptainer = (container.FILE.parent / "apptainer.def").read_text("utf-8")
    assert f"cd /{container.PROJECT}" in apptainer
    assert "bash tools/setup.sh" in apptainer
