"""Other people's searches, each used as its authors recommend; all but scipy's need the extra `skein-gcs[bench]`."""
