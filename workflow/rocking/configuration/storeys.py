"""What the configuration's yielding building must satisfy beyond the limits of its keys."""

from collections.abc import Mapping

from rocking.configuration.schema import ConfigError, show
from yade_scripts.model.chain import yields
from yade_scripts.model.registry import model


def check_storeys(resolved: Mapping) -> None:
    """Refuse a building that yields where bricks carry its masses: their storeys are elastic."""
    chain = resolved["smdof"]
    for name in resolved["models"] if yields(chain) else ():
        kind = model(name)
        if kind.two_way and not kind.single_block:
            raise ConfigError(
                f"smdof.base_shear_ratio = {show(chain['base_shear_ratio'])}: expected null with "
                f"model {name}, whose bricks carry an elastic building"
            )
