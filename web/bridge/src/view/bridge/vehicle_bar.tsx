import type { Vehicle } from '../../contract';
import { catalogue, chosenVehicle, status, vehicleId } from '../../state/store';
import { t } from '../../text';
import { moveWithArrows } from '../shared/roving';

/** The vehicles, one of which is watched. */
export function VehicleBar() {
  const vehicles = status.value?.vehicles ?? [];
  if (vehicles.length === 0)
    return (
      <p class="note">
        {t('vehicles.none')} <span class="muted">{t('vehicles.none.hint')}</span>
      </p>
    );
  return (
    <div class="chips" role="group" aria-label={t('vehicles.label')} onKeyDown={moveWithArrows}>
      <span class="muted">{t('vehicles.label')}</span>
      {vehicles.map((vehicle) => (
        <VehicleChip key={vehicle.id} vehicle={vehicle} />
      ))}
    </div>
  );
}

function VehicleChip({ vehicle: { id, system, type, autopilot, present } }: { vehicle: Vehicle }) {
  const isWatched = id === vehicleId.value;
  const label = (name: string, value: number, prefix: string) =>
    catalogue.value?.enumLabel(name, value)?.replace(prefix, '').toLowerCase().replaceAll('_', ' ');
  return (
    <button
      type="button"
      class="chip"
      data-roving
      tabIndex={isWatched ? 0 : -1}
      aria-pressed={isWatched}
      onClick={() => (chosenVehicle.value = id)}
    >
      <b>
        {isWatched && <span aria-hidden="true">✓ </span>}
        {system}
      </b>{' '}
      {label('MAV_TYPE', type, 'MAV_TYPE_')} · {label('MAV_AUTOPILOT', autopilot, 'MAV_AUTOPILOT_')} ·{' '}
      <span class="code">{id}</span>
      {!present && <span class="warning"> ▲ {t('vehicles.silent')}</span>}
    </button>
  );
}
