# The working folder's own configuration, read before Snakemake reads it: that names no line.
import sys

try:
    from rocking.configuration.files import check_files
    from rocking.configuration.schema import ConfigError
except ModuleNotFoundError:  # common.smk says so
    pass
else:
    try:
        check_files([OWN], empty=False)
    except ConfigError as error:
        sys.exit(f"error: {error}")
