"""One history of one model at one intensity: columns, picture, animation, files for ParaView."""
