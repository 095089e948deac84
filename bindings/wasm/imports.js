// For the linker alone: what the module asks of who loads it. surefoot.mjs gives it.
mergeInto(LibraryManager.library, { progress: function (label, size, done, total) {} });
