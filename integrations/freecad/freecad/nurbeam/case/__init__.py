"""Objects of a document as a case file of nurbeam, and places of the case as objects; knows no window."""
