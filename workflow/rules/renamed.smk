# Targets under the names that they had before, for one version.
FORMER_TARGETS = {"premises": "assumptions", "judge": "reference_solver"}

if workflow.is_main_process:
    terminal.warn(
        f"the target {old} is now called {new}; the old name goes"
        for old, new in FORMER_TARGETS.items()
        if old in sys.argv
    )


rule premises:
    input:
        rules.assumptions.input,


rule judge:
    input:
        rules.reference_solver.input,
