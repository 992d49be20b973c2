"""The benchmark: libmlcp and its peers on the same problems, in the same run."""
