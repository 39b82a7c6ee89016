"""Fair Fill: holes and bridges, from selected borders to new faces, operator and script."""
