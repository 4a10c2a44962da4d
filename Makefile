# make serve: install what is missing, build, serve the page on http://127.0.0.1:8080
# make test:  install what the tests need, run all of them

.PHONY: serve test

serve:
	@scripts/prepare serve
	cargo run --release --locked -- serve

test:
	@scripts/prepare test
	@scripts/test
