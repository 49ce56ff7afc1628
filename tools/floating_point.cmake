# Compiler flags on which the last bit of a result may depend; a change makes every result again (tools/step).

# No contraction into fused multiply-adds: the same seed gives the same bytes on every machine.
# Neither of the other two flags changes a value; both let the compiler use vector instructions.
add_compile_options(-ffp-contract=off -fno-math-errno -fno-trapping-math)
