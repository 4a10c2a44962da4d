/** Places to begin with: name, latitude north, longitude east, degrees. @type {[string, number, number][]} */
export const PLACES = [
  ['Greenwich', 51.4779, 0],
  ['Quito', -0.1807, -78.4678],
  ['Mauna Kea', 19.8206, -155.4681],
  ['Madrid', 40.4168, -3.7038],
  ['Saint Petersburg', 59.9386, 30.3141],
  ['Tromsø', 69.6492, 18.9553],
  ['Singapore', 1.3521, 103.8198],
  ['Tokyo', 35.6762, 139.6503],
  ['Cape Town', -33.9249, 18.4241],
  ['Paranal', -24.6272, -70.4042],
  ['South Pole', -90, 0],
];
