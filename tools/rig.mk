# Tables and figures of the reader's own rig in build/rig, with the programs of the paper's pipeline; tools/rig says how.
.PHONY: rig
#: make rig OBSERVATIONS=mine.csv [PRIOR=prior.csv] [DRIVING_FORCE=2.5]  your own rig: tables and figures in build/rig
RIG_PROGRAMS := posterior_predictive sampling_study exact_posterior table3_pbox_area fig5_tempering corner
ifneq ($(origin PRIOR),command line)
rig: export PRIOR :=
endif
rig: export BIN := $(BIN)
rig:
	@[ -z "$$OBSERVATIONS" ] || tools/build $(RIG_PROGRAMS)
	@tools/rig
