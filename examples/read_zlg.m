function log = read_zlg(path)
% READ_ZLG  A raw or angle log of zlg (HDF5) as a structure of columns.
%
%   log = read_zlg('angles.h5');
%   plot(log.t_s, cumsum(log.dtheta_final_arcsec))
%
% Of an angle log: tick, t_s, dtheta_arcsec, dtheta_final_arcsec, sigma_arcsec, mode, flags; of a raw log: half, bias_sign, mode,
% counts, loop_closed and what else it has. log.settings is the configuration as TOML, log.tick_s and log.scale_arcsec are facts of
% the log. Integers become doubles.
    info = h5info(path);
    groups = intersect({info.Groups.Name}, {'/raw', '/angles'});
    assert(~isempty(groups), '%s: neither a raw log nor an angle log', path);
    log = struct();
    columns = h5info(path, groups{1});
    for column = columns.Datasets'
        log.(column.Name) = double(h5read(path, [groups{1} '/' column.Name]));
    end
    for attribute = info.Attributes'
        log.(attribute.Name) = attribute.Value;
    end
    if any(strcmp({info.Datasets.Name}, 'config')), log.settings = h5read(path, '/config'); end
end
