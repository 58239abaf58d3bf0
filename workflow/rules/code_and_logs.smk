# What a rule with a script has where it states none: among its inputs, as `modules`, the script and all that this
# imports, so that a change there makes its files anew; and a log. Included last, when all rules are known.


def add_code_and_log(rule_):
    """Give a rule the input `modules`, and a log named by the rule and its wildcards."""
    if "modules" not in rule_.input.keys():
        parts = Path(os.path.normpath(Path(rule_.snakefile).parent / rule_.script)).parts
        last = len(parts) - parts[::-1].index("workflow")  # as the package has it, see BASE
        script = BASE.joinpath("workflow", *parts[last:])
        rule_.set_input(modules=code(script, rule_.params.get("study")))
    if not rule_.log:
        wildcards = [name for name in re.findall(r"{(\w+)", rule_.output[0]) if name != "run"]
        rule_.log_modifier = rule_.output_modifier
        rule_.set_log(logs("_".join([rule_.name, *(f"{{{name}}}" for name in wildcards)])))


# Not those of a workflow that takes this one as a module.
OWN_RULES = [rule_ for rule_ in workflow.rules if rule_.module_globals is globals()]
if fault := declarations.made_twice(OWN_RULES):
    stop(fault)
for rule_ in OWN_RULES:
    if rule_.script:
        add_code_and_log(rule_)
