"""When Snakemake chooses the next jobs."""

USUAL = (100, 1)  # starts in so many seconds: the limit that Snakemake has where none is given


def choose_at_ends_only(workflow):
    """Let jobs be chosen when one has ended.

    With a limit on starts, Snakemake 9 looks at all ready jobs anew once in its time span for
    every job that has ended while others were ready: after hundreds, all the time. Its usual limit
    is dropped; one that the user gives stays. Called in `onstart`, before the first choice.
    """
    limiter = workflow.scheduler.job_rate_limiter
    if limiter and (limiter.max_jobs, limiter.timespan) == USUAL:
        workflow.scheduler.job_rate_limiter = None
