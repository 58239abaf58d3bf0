"""Where a façade falls: searches for collapse, its probability, and what YADE confirms."""
