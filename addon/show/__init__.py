"""What is drawn: panels, menus and the quality overlay. The only room that touches the GPU."""
