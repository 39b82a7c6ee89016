"""What can be chosen: one description of each option, and Blender's properties, presets and panel made from it."""
