function build_cagedyn(include, library)
% Compiles the gateway cagedyn_mex into the present folder, in MATLAB or Octave.
%
%   build_cagedyn()                  of the installed tree that this file is in: PREFIX/share/cagedyn/matlab
%   build_cagedyn(INCLUDE, LIBRARY)  with the folders of cagedyn.h and of the shared library
%
% The gateway remembers the folder of the library (its rpath), so that the system finds it there.
here = fileparts(mfilename('fullpath'));
if nargin < 2
    prefix = fileparts(fileparts(fileparts(here)));
    include = fullfile(prefix, 'include');
    library = '';
    for folder = {'lib', 'lib64', fullfile('lib', '*-linux-gnu')}
        found = dir(fullfile(prefix, folder{1}, 'libcagedyn.*'));
        if ~isempty(found), library = found(1).folder; end
    end
    if isempty(library) || ~exist(fullfile(include, 'cagedyn.h'), 'file')
        error('cagedyn:usage', 'no cagedyn is installed in %s: name the folders, build_cagedyn(INCLUDE, LIBRARY)', prefix);
    end
end
what = {['-I' include], ['-L' library], '-lcagedyn', fullfile(here, 'cagedyn_mex.c')};
rpath = ['-Wl,-rpath,' library];
if exist('OCTAVE_VERSION', 'builtin')
    [text, status] = mkoctfile('--mex', what{:}, rpath, '-o', 'cagedyn_mex');
    if status ~= 0, error('cagedyn:usage', 'mkoctfile failed: %s', text); end
elseif ispc
    mex(what{:});
else
    mex(what{:}, ['LDFLAGS=$LDFLAGS ' rpath]);
end
end
