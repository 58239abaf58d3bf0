"""Snakemake's usual limit on starts is known and dropped, a user's stays."""

from types import SimpleNamespace

import pytest
from rocking.runtime.scheduling import choose_at_ends_only
from snakemake.cli import get_argument_parser
from snakemake.scheduling.job_scheduler import JobRateLimiter


@pytest.mark.parametrize(("words", "kept"), [([], False), (["--max-jobs-per-timespan=5/1m"], True)])
def test_only_the_usual_limit_is_dropped(words, kept):
    limit = get_argument_parser().parse_args(words).max_jobs_per_timespan
    scheduler = SimpleNamespace(job_rate_limiter=JobRateLimiter(limit))
    choose_at_ends_only(SimpleNamespace(scheduler=scheduler))
    assert (scheduler.job_rate_limiter is not None) == kept
