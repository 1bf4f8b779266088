"""What FEM's objects say, as objects of the workbench; knows no window."""
