# What a rule with a script has where it states none: among its inputs, as `modules`, the script and all that this
# imports, so that a change there makes its files anew; and a log. Included last, when all rules are known.


def add_code_and_log(own):
    """Give a rule the input `modules`, and a log named by the rule and its wildcards."""
    if "modules" not in own.input.keys():
        parts = Path(os.path.normpath(Path(own.snakefile).parent / own.script)).parts
        last = len(parts) - parts[::-1].index("workflow")  # as the package has it, see BASE
        script = BASE.joinpath("workflow", *parts[last:])
        own.set_input(modules=code(script, own.params.get("study")))
    if not own.log:
        wildcards = [name for name in re.findall(r"{(\w+)", own.output[0]) if name != "run"]
        own.log_modifier = own.output_modifier
        own.set_log(logs("_".join([own.name, *(f"{{{name}}}" for name in wildcards)])))


for one in workflow.rules:
    # not those of a workflow that takes this one as a module
    if one.script and one.module_globals is globals():
        add_code_and_log(one)
