"""What is drawn: panels, menus, tools, arrows and marks in the view."""
