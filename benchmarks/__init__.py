"""How fast mpslab is: benchmarks, paired runs, and a model of what many ranks would bring."""
