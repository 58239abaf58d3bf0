"""Static curves of elastic walls and of the rigid blocks that stand for them."""

from rocking.runtime.script import run
from rocking.studies.base_compliance import static
from rocking.tables import write_table


def main(job):
    write_table(static(), job.output[0])


run(main, globals())
