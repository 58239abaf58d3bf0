"""What holds a façade while it is shaken, and the model that its rate rests on: no solver loads."""

SETTLED = (  # keys of section assessment
    *("floor_friction", "anchor_plate_m", "masonry_shear_mpa", "masonry_compression_mpa"),
    "confidence_factor",
)
GOVERNS = "W2m"  # where it is among a run's
