"""The command and the module of nurbeam: cases are run, results read; knows no window."""
